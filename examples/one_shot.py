# SPDX-License-Identifier: Apache-2.0
"""A client of the simulator: one shot, and what became of it. `python3 one_shot.py`, with ROS 2 sourced."""
import json

import rclpy
from geometry_msgs.msg import Twist
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node('golfer')
results = []
node.create_subscription(String, 'shot/result', lambda told: results.append(json.loads(told.data)), 10)
shots = node.create_publisher(Twist, 'shot', 10)
while not (shots.get_subscription_count() and node.count_publishers('shot/result')):
    rclpy.spin_once(node, timeout_sec=0.1)  # until the simulator is found

shot = Twist()
shot.linear.x, shot.linear.z = 65.0, 14.0   # m/s: to the target, and up
shot.angular.y = -280.0                     # rad/s: backspin
shots.publish(shot)
while not results:
    rclpy.spin_once(node, timeout_sec=0.1)
print('{status}: {carry:.1f} m carry, {total:.1f} m in all, {to_hole} m to the hole'.format(**results[0]))
rclpy.shutdown()
