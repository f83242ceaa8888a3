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

"""Stand-ins for what the rclpy of ROS 2 Humble (3.3) lacks.

A newer one's own functions are used.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from rcl_interfaces.msg import ParameterEvent
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import qos_profile_parameter_events
from rclpy.subscription import Subscription

try:
    from rclpy.event_handler import (
        PublisherEventCallbacks,
        SubscriptionEventCallbacks,
        UnsupportedEventTypeError,
    )
except ImportError:
    from rclpy.qos_event import SubscriptionEventCallbacks, UnsupportedEventTypeError  # noqa: F401

    PublisherEventCallbacks = None

PERIOD = 0.2  # s from one count of subscriptions to the next


def after_set(node: Node, callback: Callable[[list[Parameter]], None]) -> None:
    """Register `callback(parameters)`, called whenever parameters of `node` have been set.

    Without `add_post_set_parameters_callback` the node subscribes to its own parameter events.
    """
    if hasattr(node, 'add_post_set_parameters_callback'):
        node.add_post_set_parameters_callback(callback)
        return
    node.create_subscription(
        ParameterEvent,
        '/parameter_events',
        partial(_on_event, node, callback),
        qos_profile_parameter_events,
    )


def _on_event(
    node: Node, callback: Callable[[list[Parameter]], None], event: ParameterEvent
) -> None:
    """Pass on the parameters that an event says were set, if it is about this node."""
    if event.node == node.get_fully_qualified_name() and event.changed_parameters:
        callback([Parameter.from_parameter_msg(changed) for changed in event.changed_parameters])


def on_match(callback: Callable[[], None]) -> Any:
    """Make event callbacks of publishers that call `callback` when one more subscription matches.

    None where there is no such event; there `watch` the publishers.
    """
    if PublisherEventCallbacks is None:
        return None
    return PublisherEventCallbacks(
        matched=lambda status: callback() if status.current_count_change > 0 else None
    )


def watch(node: Node, publishers: Sequence[Publisher], callback: Callable[[], None]) -> None:
    """Call `callback` when one of `publishers` has more subscriptions.

    Only where `on_match` gives None.
    """
    if PublisherEventCallbacks is None:
        counts = [0] * len(publishers)
        node.create_timer(
            PERIOD,
            partial(_compare, publishers, counts, callback),
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )


def _compare(
    publishers: Sequence[Publisher], counts: list[int], callback: Callable[[], None]
) -> None:
    """Call `callback` if any subscription was added since the last call; writes `counts`."""
    now = [publisher.get_subscription_count() for publisher in publishers]
    joined = any(new > old for new, old in zip(now, counts))
    counts[:] = now
    if joined:
        callback()


def publisher_count(node: Node, subscription: Subscription) -> int:
    """Count the publishers that a subscription of `node` has."""
    if hasattr(subscription, 'get_publisher_count'):
        return subscription.get_publisher_count()
    return node.count_publishers(subscription.topic_name)
