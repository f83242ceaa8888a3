# SPDX-License-Identifier: Apache-2.0
"""ROS messages from records of the physics, and back."""
import json
from math import isfinite

from geometry_msgs.msg import PointStamped, PoseStamped, TwistStamped
from rclpy.time import Time
from std_msgs.msg import Header, String

RESULT = ('shot', 'ball', 'status', 'carry', 'carry_side', 'total', 'side', 'apex', 'flight_time',
          'duration', 'to_hole', 'lie', 'landing_speed', 'landing_angle', 'bounces', 'time',
          'position', 'velocity', 'spin', 'reason')
REJECTION = ('shot', 'ball', 'status', 'velocity', 'spin', 'reason')
COLLISION = ('time', 'ball', 'kind', 'with', 'position', 'normal', 'velocity_before',
             'velocity_after', 'spin_before', 'spin_after', 'impulse')
DIGITS = 4  # of lengths, speeds and angles in a result; `time` has two more


def header(frame, start, time):
    """Header in `frame` for simulated `time` [s] of a node that started at `start` [ns of ROS time]."""
    stamp = Time(nanoseconds=start + round(time * 1e9)).to_msg()
    return Header(stamp=stamp, frame_id=frame)


def triple(vector):
    """Three floats of a Vector3 or Point."""
    return vector.x, vector.y, vector.z


def fill(message, vector):
    """`message`, a Vector3 or Point, after `vector` was written to it."""
    message.x, message.y, message.z = (float(number) for number in vector)
    return message


def pose(head, ball, orientation):
    """PoseStamped of `ball`, turned by the quaternion `orientation` (x, y, z, w)."""
    message = PoseStamped(header=head)
    fill(message.pose.position, ball.position)
    turn = message.pose.orientation
    turn.x, turn.y, turn.z, turn.w = orientation
    return message


def twist(head, ball):
    """TwistStamped of velocity and spin of `ball`."""
    message = TwistStamped(header=head)
    fill(message.twist.linear, ball.velocity)
    fill(message.twist.angular, ball.spin)
    return message


def contact(head, collision):
    """PointStamped where `collision` happened."""
    message = PointStamped(header=head)
    fill(message.point, collision.position)
    return message


def collision_json(collision):
    """String with one JSON object, in full precision."""
    values = collision._asdict()
    values['with'] = values['with_']
    return text({key: values[key] for key in COLLISION})


def result_json(result, shot):
    """String with one JSON object for the end of strike number `shot`, rounded for people."""
    values = {**result._asdict(), 'shot': shot}
    rounded = {key: plain(values[key], DIGITS) for key in RESULT}
    return text({**rounded, 'time': plain(result.time, DIGITS + 2)})


def rejection_json(shot, ball, velocity, spin, reason):
    """String with one JSON object for strike number `shot`, which was not played."""
    values = (shot, ball, 'rejected', plain(velocity, DIGITS), plain(spin, DIGITS), reason)
    return text(dict(zip(REJECTION, values)))


def plain(value, digits):
    """`value` for JSON: floats rounded, or None where not finite; never a negative zero."""
    if isinstance(value, float):
        return round(value, digits) + 0.0 if isfinite(value) else None
    if isinstance(value, (tuple, list)):
        return [plain(part, digits) for part in value]
    return value


def text(values):
    """String message with `values` as JSON."""
    return String(data=json.dumps(values, allow_nan=False))
