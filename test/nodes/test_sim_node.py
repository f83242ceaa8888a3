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

"""sim_node over DDS: what a player, a late viewer and a wind generator meet."""

import json
import signal
import threading

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PointStamped, PoseStamped, Twist, TwistStamped, Vector3Stamped
from golf_sim_ros.nodes.conversions import triple
from golf_sim_ros.nodes.parameters import Parameters
from golf_sim_ros.nodes.sim_node import SimNode
from golf_sim_ros.physics.effects.turbulence import box_of
from processes import LASTING, LATCHED, parameters, place, READY, seconds, wait_until
import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, ListParameters, SetParameters
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from std_srvs.srv import SetBool
from visualization_msgs.msg import Marker, MarkerArray

CHIP, CHIP_SPIN = (9.0, 0.5, 6.0), (0.0, -100.0, 0.0)
TURBULENT = {'turbulence': 0.2, 'turbulence_seed': 7}
PERIOD, TICK = 1 / 50, 1 / 250  # s, by default


@pytest.fixture(scope='module')
def sim(start):
    """Start a sim with default parameters in the root namespace."""
    process = start('sim_node')
    process.wait_for(READY)
    return process


@pytest.fixture
def golfer(sim, make_golfer):
    """Make a golfer whose ball is on the tee."""
    golfer = make_golfer()
    golfer.reset()
    return golfer


def test_a_twist_moves_the_ball_and_exactly_one_result_comes_back(golfer):
    start = place(golfer.poses[-1])
    result = golfer.play((10.0, 1.0, 6.0), CHIP_SPIN)
    golfer.heartbeat()
    assert len(golfer.results_of((10.0, 1.0, 6.0), CHIP_SPIN)) == 1
    assert result['status'] == 'at_rest' and result['ball'] == 'ball'
    end = place(golfer.poses[-1])
    assert end == pytest.approx(result['position'], abs=1e-4)
    assert result['total'] == pytest.approx(
        ((end[0] - start[0]) ** 2 + (end[1] - start[1]) ** 2) ** 0.5, abs=1e-4
    )
    assert result['total'] > result['carry'] > 5.0
    assert max(place(pose)[2] for pose in golfer.poses) == pytest.approx(
        start[2] + result['apex'], abs=0.01
    )


def test_shot_without_a_ball_strikes_the_first_ball(golfer):
    golfer.shots = golfer.publisher(Twist, 'shot')
    assert golfer.play((10.0, 2.0, 6.0))['ball'] == 'ball'


def test_the_first_moving_pose_is_stamped_within_two_publish_periods_of_the_strike(golfer):
    rest = place(golfer.poses[-1])
    golfer.poses.clear()
    result = golfer.play(CHIP, CHIP_SPIN)
    wait_until(lambda: golfer.contacts, 'a contact came')
    golfer.heartbeat()
    began = seconds(golfer.contacts[-1].header.stamp) - golfer.impacts()[-1]['time']
    moving = next(pose for pose in golfer.poses if place(pose) != rest)
    after = seconds(moving.header.stamp) - began - (result['time'] - result['duration'])
    assert -1e-3 < after <= 2 * PERIOD + 1e-3


def test_stamps_are_whole_ticks_and_a_moving_ball_is_told_at_the_publish_rate(golfer):
    golfer.poses.clear()
    golfer.play((9.5, 0.5, 6.0), CHIP_SPIN)
    golfer.heartbeat()
    stamps = [seconds(pose.header.stamp) for pose in golfer.poses]
    steps = [(after - before) / TICK for before, after in zip(stamps, stamps[1:])]
    assert steps == pytest.approx([round(step) for step in steps], abs=1e-3)
    assert min(steps) >= 0
    moving = sorted(step for step in steps if step > 0)
    assert moving[len(moving) // 2] == pytest.approx(PERIOD / TICK, abs=1.5)


def test_a_pose_turns_with_the_spin_and_stays_of_unit_length(golfer):
    golfer.play((9.6, 0.5, 6.0), (50.0, -100.0, 20.0))
    golfer.heartbeat()
    turns = [pose.pose.orientation for pose in golfer.poses]
    assert len({(turn.x, turn.y, turn.z, turn.w) for turn in turns}) > 10
    assert all(
        turn.x**2 + turn.y**2 + turn.z**2 + turn.w**2 == pytest.approx(1.0) for turn in turns
    )


def test_twist_tells_velocity_and_spin_in_the_courses_frame(golfer):
    twists = golfer.listen(TwistStamped, 'ball/twist')
    wait_until(lambda: twists, 'a twist came')
    golfer.play((9.7, 0.5, 6.0), CHIP_SPIN)
    golfer.heartbeat()
    first = next(twist.twist for twist in twists if twist.twist.linear.z > 0.5)
    assert triple(first.linear) == pytest.approx((9.7, 0.5, 6.0), abs=0.5)
    assert triple(first.angular) == pytest.approx(CHIP_SPIN, abs=1.0)
    assert twists[-1].twist.linear.x == 0.0 and twists[-1].header.frame_id == 'course'


def test_collisions_are_told_as_json_in_the_contracts_order_and_as_points(golfer):
    before = len(golfer.contacts)
    told = len(golfer.collisions)
    result = golfer.play((9.8, 0.5, 6.0), CHIP_SPIN)
    golfer.heartbeat()
    impacts = golfer.impacts()[told:]
    assert len(impacts) == result['bounces'] == len(golfer.contacts) - before
    assert list(impacts[0]) == [
        'time',
        'ball',
        'kind',
        'with',
        'position',
        'normal',
        'velocity_before',
        'velocity_after',
        'spin_before',
        'spin_after',
        'impulse',
    ]
    first = impacts[0]
    assert (first['kind'], first['ball']) == ('bounce', 'ball')
    assert first['velocity_before'][2] < 0 < first['velocity_after'][2]
    landed = result['time'] - result['duration'] + result['flight_time']
    assert first['time'] == pytest.approx(landed, abs=3e-4)
    point = golfer.contacts[before].point
    assert [point.x, point.y, point.z] == first['position']


def test_who_comes_late_gets_the_course_the_last_result_and_the_pose(golfer, client):
    result = golfer.play((9.9, 0.5, 6.0), CHIP_SPIN)
    latched = client.listen(MarkerArray, 'course/markers', LATCHED)
    volatile = client.listen(MarkerArray, 'course/markers', 1)
    results = client.listen(String, 'shot/result', LASTING)
    poses = client.listen(PoseStamped, 'ball/pose')
    wait_until(lambda: latched and volatile and results and poses, 'all of it came', 10.0)
    wait_until(lambda: json.loads(results[-1].data) == result, 'the last result came')
    assert place(poses[0]) == pytest.approx(result['position'], abs=1e-4)
    assert latched[0].markers and latched[0] == volatile[0]
    assert all(seconds(marker.header.stamp) == 0 for marker in latched[0].markers)


def test_a_second_volatile_viewer_gets_the_course_too(golfer, make_client):
    for _ in range(2):
        seen = make_client().listen(MarkerArray, 'course/markers', 1)
        wait_until(lambda: seen, 'the course came', 10.0)


@pytest.mark.parametrize(
    'number, qos',
    list(
        enumerate(
            [
                QoSProfile(depth=10),
                QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL),
                QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT),
            ]
        )
    ),
    ids=['default', 'transient local', 'best effort'],
)
def test_a_wind_of_any_quality_of_service_reaches_the_sim(sim, client, number, qos):
    wind = (1.0 + number, -2.0, 0.0)
    scenes = client.listen(MarkerArray, 'play/markers')
    winds = client.publisher(Vector3Stamped, 'wind', qos)
    assert blows(winds, scenes, wind)
    assert blows(winds, scenes, (0.0, 0.0, 0.0))


def blows(winds, scenes, wind):
    """Whether the sim's arrow comes to show `wind`, which is published until then."""
    message = Vector3Stamped()
    message.vector.x, message.vector.y, message.vector.z = wind

    def seen():
        winds.publish(message)
        return scenes and arrow(scenes[-1]) == pytest.approx(wind)

    return wait_until(seen, f'the sim felt the wind {wind}', 20.0)


def arrow(scene):
    """Wind that a MarkerArray shows."""
    shown = next(marker for marker in scene.markers if marker.ns == 'wind')
    if shown.action == Marker.DELETE:
        return 0.0, 0.0, 0.0
    tail, tip = shown.points
    return tip.x - tail.x, tip.y - tail.y, tip.z - tail.z


def test_a_wind_from_the_right_carries_the_ball_to_the_left(golfer, client):
    scenes = client.listen(MarkerArray, 'play/markers')
    winds = client.publisher(Vector3Stamped, 'wind')
    calm = golfer.play((15.0, 0.0, 15.0))
    golfer.reset()
    assert blows(winds, scenes, (0.0, 15.0, 0.0))
    windy = golfer.play((15.0, 0.0, 15.001))
    assert blows(winds, scenes, (0.0, 0.0, 0.0))
    assert abs(calm['carry_side']) < 0.01 < 0.3 < windy['carry_side']


def test_diagnostics_tell_how_the_simulation_keeps_up_and_what_it_simulates(sim, client):
    heard = client.listen(DiagnosticArray, '/diagnostics')
    wait_until(lambda: len(heard) > 1, 'diagnostics came')
    status = heard[-1].status[0]
    values = {value.key: value.value for value in status.values}
    assert status.name == '/golf_sim: play'
    assert float(values['real-time factor']) > 0.5
    assert float(values['tick time p99 [us]']) >= float(values['tick time p50 [us]']) > 0.0
    assert float(values['tick time max [us]']) >= float(values['tick time p99 [us]'])
    assert int(values['ticks made up']) >= 0
    stages = ('flight', 'contact', 'broad phase', 'publish', 'all of a tick', 'all of the process')
    shares = [float(values[f'share of a core, {stage} [%]']) for stage in stages]
    assert all(share >= 0.0 for share in shares) and sum(shares[:3]) <= shares[4] + 0.01
    assert float(values['error at most, first touch [m]']) == 1e-3
    assert float(values['error at most, rest [m]']) == 1e-2
    assert (
        values['effects asked for in vain'] == 'none' and 'effect off: linear_drag' not in values
    )
    assert 'gravity' in values['effects on'] and values['effect off: wind']
    assert 'wind age [s]' in values


def test_a_reset_ends_the_shot_as_aborted_and_puts_the_ball_back(golfer):
    start = place(golfer.poses[-1])
    golfer.strike((30.0, 0.0, 40.0))
    wait_until(lambda: place(golfer.poses[-1])[2] > 5.0, 'the ball flew')
    golfer.reset()
    result = wait_until(lambda: golfer.results_of((30.0, 0.0, 40.0)), 'the result came')[0]
    golfer.heartbeat()
    assert result['status'] == 'aborted' and result['apex'] > 4.0
    assert place(golfer.poses[-1]) == start
    assert golfer.play((8.0, 0.0, 5.0))['status'] == 'at_rest'


def test_a_strike_while_paused_is_played_when_time_goes_on(golfer):
    assert golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=True)).success
    golfer.heartbeat()
    still = golfer.poses[-1]
    golfer.strike((8.1, 0.0, 5.0))
    golfer.heartbeat()
    assert golfer.poses[-1] == still
    assert golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=False)).success
    assert (
        wait_until(lambda: golfer.results_of((8.1, 0.0, 5.0)), 'it came')[0]['status'] == 'at_rest'
    )


def test_a_placed_ball_lies_on_the_ground_and_is_struck_from_there(golfer):
    places = golfer.publisher(PointStamped, 'ball/place')
    message = PointStamped()
    message.point.x, message.point.y, message.point.z = 340.0, 2.0, 99.0
    places.publish(message)
    wait_until(lambda: place(golfer.poses[-1])[:2] == (340.0, 2.0), 'the ball was placed')
    assert place(golfer.poses[-1])[2] < 1.0
    putt = golfer.play((0.5, 0.0, 0.0))
    assert putt['lie'] == 'green' and putt['carry'] == putt['flight_time'] == putt['bounces'] == 0


def test_accuracy_is_live_and_the_rate_is_read_only(sim, client):
    def set_to(name, value):
        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
        return client.call(SetParameters, 'golf_sim/set_parameters', request).results[0]

    def text(value):
        return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=value)

    refused = set_to('accuracy', text('perfect'))
    assert not refused.successful and 'sketch, standard, reference' in refused.reason
    assert set_to('accuracy', text('sketch')).successful
    heard = client.listen(DiagnosticArray, '/diagnostics')
    wait_until(lambda: heard and accuracy(heard[-1]) == 'sketch', 'the sim followed')
    assert set_to('accuracy', text('standard')).successful
    rate = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=100.0)
    assert not set_to('rate', rate).successful
    sim_time = ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=True)
    assert not set_to('use_sim_time', sim_time).successful


def accuracy(diagnostics):
    return next(value.value for value in diagnostics.status[0].values if value.key == 'accuracy')


def test_every_parameter_is_described(sim, client):
    request = ListParameters.Request()
    names = client.call(ListParameters, 'golf_sim/list_parameters', request).result.names
    own = [name for name in names if name != 'use_sim_time' and '.' not in name]
    assert {*Parameters._fields} <= set(own)
    request = DescribeParameters.Request(names=own)
    described = client.call(
        DescribeParameters, 'golf_sim/describe_parameters', request
    ).descriptors
    own_ones = [d for d in described if d.name not in ('start_type_description_service',)]
    assert all(descriptor.description for descriptor in own_ones)
    assert [d.name for d in own_ones if not d.read_only] == ['real_time_factor', 'accuracy']
    assert all(
        d.floating_point_range for d in own_ones if d.type == ParameterType.PARAMETER_DOUBLE
    )


def test_the_log_tells_the_course_the_effects_a_line_to_paste_and_every_shot(golfer, sim):
    result = golfer.play((25.0, 1.0, 12.0), (0.0, -200.0, 0.0))
    line = sim.wait_for(f'total {result["total"]:.0f} m')
    assert 'wedge-like shot: carry' in line and f'{result["to_hole"]:.0f} m to the hole' in line
    assert 'course: Golf without friends' in sim.output
    assert (
        'simulated: ' in sim.output
        and 'left out: ' in sim.output
        and 'wind (no wind)' in sim.output
    )
    assert "ros2 topic pub --once /shot geometry_msgs/msg/Twist '{linear:" in sim.output


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_sim_with_exit_code_0(start, number):
    process = start('sim_node', *parameters('/ending'))
    process.wait_for(READY)
    assert process.stop(number) == 0
    assert 'Traceback' not in process.output


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_a_flying_sim_with_exit_code_0(start, make_golfer, number):
    process = start('sim_node', *parameters('/flying'))
    process.wait_for(READY)
    golfer = make_golfer('/flying')
    golfer.strike((40.0, 0.0, 40.0))
    wait_until(lambda: place(golfer.poses[-1])[2] > 3.0, 'the ball flew')
    assert process.stop(number) == 0
    assert 'Traceback' not in process.output and 'FATAL' not in process.output


def test_two_balls_are_struck_apart_and_fly_at_the_same_time(start, make_golfer):
    start('sim_node', *parameters('/two', balls="['red', 'blue']")).wait_for(READY)
    red, blue = make_golfer('/two', 'red'), make_golfer('/two', 'blue')
    assert abs(place(red.poses[-1])[1] - place(blue.poses[-1])[1]) == pytest.approx(0.5)
    red.strike(CHIP)
    result = blue.play((9.0, -0.5, 6.0))
    other = wait_until(lambda: red.results_of(CHIP), 'the other result came')[0]
    assert (result['ball'], other['ball'], {result['shot'], other['shot']}) == (
        'blue',
        'red',
        {1, 2},
    )
    assert result['total'] == pytest.approx(other['total'], rel=1e-6)
    assert len(red.results_of(CHIP)) == 1


def test_the_balls_of_two_players_collide_and_each_has_one_result(start, make_golfer):
    start('sim_node', *parameters('/duel', balls="['red', 'blue']")).wait_for(READY)
    red, blue = make_golfer('/duel', 'red'), make_golfer('/duel', 'blue')
    towards = round(place(blue.poses[-1])[1] - place(red.poses[-1])[1], 3)
    strikes = (0.0, 4.0 * towards, 0.0), (0.0, -3.0 * towards, 0.0)
    red.strike(strikes[0])
    blue.strike(strikes[1])
    for golfer, strike in zip((red, blue), strikes):
        result = wait_until(lambda: golfer.results_of(strike), 'its result came')[0]
        assert result['status'] == 'at_rest'
    bump = [c for c in red.impacts() if c['kind'] == 'ball'][0]
    assert {bump['ball'], bump['with']} == {'red', 'blue'}
    assert bump['impulse'][1] * bump['normal'][1] > 0.0
    wait_until(lambda: red.contacts and blue.contacts, 'both balls were told the contact')
    red.heartbeat()
    assert len(red.results_of(strikes[0])) == len(blue.results_of(strikes[1])) == 1


def test_a_namespace_and_a_remapped_topic_appear_in_the_line_to_paste(start):
    process = start('sim_node', *parameters('/mapped'), '-r', 'shot:=hit')
    assert '--once /mapped/hit geometry_msgs' in process.wait_for(READY)


@pytest.fixture
def context(domain):
    """Give a context in which this process can have nodes of its own."""
    context = rclpy.context.Context()
    rclpy.init(context=context, domain_id=domain)
    yield context
    context.try_shutdown()


def test_eddies_are_made_before_the_first_gust(context):
    box_of.cache_clear()
    given = [rclpy.Parameter(name, value=value) for name, value in TURBULENT.items()]
    sim = SimNode(context=context, parameter_overrides=given)
    assert box_of.cache_info().currsize == 1
    sim.game.set_live('wind', (3.0, 4.0, 0.0))
    sim.game.apply()
    assert sim.world.live['wind'] == (3.0, 4.0, 0.0)
    assert 'turbulence' in sim.world.effects_on and box_of.cache_info().currsize == 1
    sim.destroy_node()


def test_two_sims_in_one_process_play_apart(context, make_golfer):
    names = ('/left', '/right')
    sims = [
        SimNode(
            context=context,
            namespace=name,
            parameter_overrides=[rclpy.Parameter('frame_id', value=name[1:])],
        )
        for name in names
    ]
    executor = rclpy.executors.SingleThreadedExecutor(context=context)
    for sim in sims:
        executor.add_node(sim)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    golfers = [make_golfer(name) for name in names]
    result = golfers[0].play(CHIP)
    assert result['status'] == 'at_rest'
    golfers[1].heartbeat()
    assert not golfers[1].results and golfers[1].poses[-1].header.frame_id == 'right'
    executor.shutdown()
    thread.join()
    for sim in sims:
        sim.destroy_node()
