# Copyright 2026 golf_sim_ros maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""First on PYTHONPATH, takes from rclpy what that of Humble (3.3) has not.

AS_HUMBLE names what stays.
"""

import os
import sys
from types import ModuleType

from rclpy.event_handler import SubscriptionEventCallbacks, UnsupportedEventTypeError
from rclpy.node import Node
from rclpy.subscription import Subscription

KEPT = os.environ.get('AS_HUMBLE', '').split()
for owner, name in (
    (Node, 'add_pre_set_parameters_callback'),
    (Node, 'add_post_set_parameters_callback'),
    (Subscription, 'get_publisher_count'),
):
    if name not in KEPT:
        delattr(owner, name)
sys.modules['rclpy.qos_event'] = older = ModuleType('rclpy.qos_event')
older.SubscriptionEventCallbacks = SubscriptionEventCallbacks
older.UnsupportedEventTypeError = UnsupportedEventTypeError
for module in ('rclpy.event_handler', 'rclpy.experimental'):
    sys.modules[module] = None  # importing it raises ImportError
print('rclpy as in Humble', file=sys.stderr)
