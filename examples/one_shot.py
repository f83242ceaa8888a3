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

"""A client of the simulator: one shot, and what became of it."""

import json

from geometry_msgs.msg import Twist
import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node('golfer')
results = []
node.create_subscription(String, 'shot/result', lambda told: results.append(told.data), 10)
shots = node.create_publisher(Twist, 'shot', 10)
while not (shots.get_subscription_count() and node.count_publishers('shot/result')):
    rclpy.spin_once(node, timeout_sec=0.1)  # until the simulator is found

shot = Twist()
shot.linear.x, shot.linear.z = 65.0, 14.0  # m/s: to the target, and up
shot.angular.y = -280.0  # rad/s: backspin
shots.publish(shot)
while not results:
    rclpy.spin_once(node, timeout_sec=0.1)
said = '{status}: {carry:.1f} m carry, {total:.1f} m in all, {to_hole} m to the hole'
print(said.format(**json.loads(results[0])))
rclpy.shutdown()
