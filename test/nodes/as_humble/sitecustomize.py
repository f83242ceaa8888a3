# SPDX-License-Identifier: Apache-2.0
"""First on PYTHONPATH, takes from rclpy what that of Humble (3.3) has not; AS_HUMBLE names what stays."""
import os
import sys
from types import ModuleType

from rclpy.event_handler import SubscriptionEventCallbacks, UnsupportedEventTypeError
from rclpy.node import Node
from rclpy.subscription import Subscription

KEPT = os.environ.get('AS_HUMBLE', '').split()
for owner, name in ((Node, 'add_pre_set_parameters_callback'), (Node, 'add_post_set_parameters_callback'),
                    (Subscription, 'get_publisher_count')):
    if name not in KEPT:
        delattr(owner, name)
sys.modules['rclpy.qos_event'] = older = ModuleType('rclpy.qos_event')
older.SubscriptionEventCallbacks = SubscriptionEventCallbacks
older.UnsupportedEventTypeError = UnsupportedEventTypeError
for module in ('rclpy.event_handler', 'rclpy.experimental'):
    sys.modules[module] = None  # importing it raises ImportError
print('rclpy as in Humble', file=sys.stderr)
