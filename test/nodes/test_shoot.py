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

"""`shoot` over DDS: with the real sim, and with one that answers as the test wants it to."""

import json
from math import atan2, cos, degrees, hypot, radians, sin
import signal

from geometry_msgs.msg import PoseStamped, Twist
from processes import Client, LASTING, LATCHED, parameters, place, wait_until
import pytest
from std_msgs.msg import String
from std_srvs.srv import SetBool
from visualization_msgs.msg import Marker, MarkerArray
import yaml

MPH, YARD = 0.44704, 0.9144


class ScriptedSim(Client):
    """Offers the topics of a sim, and answers strikes with what `answer(number)` changes in it."""

    def __init__(self, namespace, ball='ball', hole=None, course=True):
        super().__init__(namespace)
        self.ball, self.struck, self.answer = ball, [], lambda number: {}
        self.place, self.at_tick = (10.0, 20.0), lambda: None
        self.results = self.publisher(String, 'shot/result', LASTING, wait=False)
        self.poses = self.publisher(PoseStamped, f'{ball}/pose', wait=False)
        if course:
            self.show_course(hole)
        self.node.create_timer(0.05, self.tick)
        for topic in ('shot', f'{ball}/shot'):
            self.node.create_subscription(Twist, topic, self.on_shot, 10)

    def show_course(self, hole):
        markers = [Marker(ns='ground', id=0)]
        if hole is not None:
            markers += [Marker(ns='hole', id=2), Marker(ns='hole', id=0)]
            markers[-1].pose.position.x, markers[-1].pose.position.y = hole
        course = self.publisher(MarkerArray, 'course/markers', LATCHED, wait=False)
        course.publish(MarkerArray(markers=markers))

    def tick(self):
        message = PoseStamped()
        message.pose.position.x, message.pose.position.y = self.place
        self.poses.publish(message)
        self.at_tick()

    def on_shot(self, message):
        linear, angular = message.linear, message.angular
        self.struck.append(((linear.x, linear.y, linear.z), (angular.x, angular.y, angular.z)))
        answer = self.answer(len(self.struck))
        if answer is not None:
            self.tell_result(**answer)

    def tell_result(self, **changes):
        velocity, spin = ([round(number, 4) for number in vector] for vector in self.struck[-1])
        result = {
            'shot': len(self.struck),
            'ball': self.ball,
            'status': 'at_rest',
            'carry': 91.44,
            'carry_side': 0.0,
            'total': 100.0,
            'side': 0.0,
            'apex': 20.0,
            'flight_time': 4.0,
            'duration': 8.0,
            'to_hole': None,
            'lie': 'green',
            'landing_speed': 20.0,
            'landing_angle': 0.7,
            'bounces': 4,
            'time': 9.0,
            'position': [110.0, 20.0, 0.02],
            'velocity': velocity,
            'spin': spin,
            'reason': '',
        }
        self.results.publish(String(data=json.dumps({**result, **changes})))


@pytest.fixture
def scripted(domain):
    """Give a function of a namespace that makes a ScriptedSim, closed after the test."""
    sims = []

    def make(namespace, **how):
        sims.append(ScriptedSim(namespace, **how))
        return sims[-1]

    yield make
    for sim in sims:
        sim.close()


@pytest.fixture
def shoot(start):
    """Give a function that runs `shoot` with a line: exit code and output.

    It looks for a sim for long.
    """

    def run(line):
        process = start('cli.shoot', '--timeout', '60', *line.split())
        code = process.wait()  # on a busy machine a sim may be found late, and that be said
        return code, ''.join(line for line in process.lines if not line.endswith(' yet\n'))

    return run


def test_without_a_sim_it_says_so_in_one_line_and_exits_with_one(shoot):
    assert shoot('driver --namespace /nobody --timeout 0.5') == (
        1,
        'shoot: no sim answers on /nobody/shot within 0.5 s\n',
    )


def test_what_listens_but_shows_no_course_is_no_sim(shoot, scripted):
    scripted('/blind', course=False)
    assert shoot('driver --namespace /blind --timeout 6') == (
        1,
        'shoot: a sim listens on /blind/shot, but shows no course within 6 s\n',
    )


def test_a_played_shot_is_printed_as_a_table_and_exits_with_zero(shoot, scripted):
    sim = scripted('/table')
    code, output = shoot('pw --namespace /table')
    assert code == 0
    assert len(sim.struck) == 1
    lines = output.splitlines()
    assert lines[0] == (
        'pw: 102.0 mph, launch 24.2 deg, azimuth 0.0 deg, backspin 9304 rpm, sidespin 0 rpm'
    )
    assert 'ended          at rest, green' in lines
    assert 'carry            100.00 yd' in lines


def test_a_rejected_shot_exits_with_one_and_the_reason_in_one_line(shoot, scripted):
    scripted('/strict').answer = lambda number: {
        'status': 'rejected',
        'reason': 'the ball is moving',
    }
    code, output = shoot('pw --namespace /strict')
    assert code == 1
    assert output.splitlines()[1:] == ['shoot: rejected: the ball is moving']


def test_a_shot_that_a_reset_ends_exits_with_one(shoot, scripted):
    scripted('/reset').answer = lambda number: {'status': 'aborted'}
    code, output = shoot('pw --namespace /reset')
    assert code == 1
    assert output.splitlines()[1:] == ['shoot: aborted']


def test_the_result_of_the_same_shot_hit_earlier_is_not_taken_for_its_own(shoot, scripted):
    sim = scripted('/again')
    sim.answer = lambda number: {'carry': 100.0 * number}
    for number in range(1, 4):
        code, output = shoot('pw --units si --namespace /again')
        assert code == 0
        assert f'carry            {100 * number}.00 m\n' in output


def test_the_results_of_other_shots_are_not_taken_for_its_own(shoot, scripted):
    sim = scripted('/busy')

    def others_first(number):
        for change in (
            {'velocity': [1.0, 2.0, 3.0]},
            {'spin': [1.0, 2.0, 3.0]},
            {'velocity': [None, 2.0, 3.0]},
            {'ball': 'red'},
        ):
            sim.tell_result(carry=1.0, **change)
        return {}

    sim.answer = others_first
    code, output = shoot('pw --namespace /busy --ball ball')
    assert code == 0
    assert 'carry            100.00 yd' in output


def test_a_shot_under_way_is_not_ended_by_the_rejection_of_another_just_like_it(shoot, scripted):
    sim = scripted('/twins')
    ticks = iter(range(1000000))

    def fly():
        if not sim.struck:
            return
        now = next(ticks)
        sim.place = (10.0 + now, 20.0)
        if now == 40:
            sim.tell_result(status='rejected', reason='the ball is moving', shot=2)
        if now == 50:
            sim.tell_result()

    sim.answer, sim.at_tick = lambda number: None, fly
    code, output = shoot('pw --namespace /twins')
    assert code == 0
    assert 'carry            100.00 yd' in output


def test_a_late_rejection_counts_where_the_ball_has_not_moved(shoot, scripted):
    sim = scripted('/paused')
    ticks = iter(range(1000000))

    def resume():
        if sim.struck and next(ticks) == 40:
            sim.tell_result(status='rejected', reason='the ball is moving')

    sim.answer, sim.at_tick = lambda number: None, resume
    code, output = shoot('pw --namespace /paused')
    assert code == 1
    assert output.splitlines()[1:] == ['shoot: rejected: the ball is moving']


def test_it_exits_with_one_when_the_sim_goes_away_during_the_shot(shoot, scripted):
    sim = scripted('/leaving')
    other = {'velocity': [0.0, 0.0, 1.0]}

    def leave(number):
        sim.node.destroy_publisher(sim.results)
        sim.results = sim.publisher(String, 'elsewhere', wait=False)
        return other

    sim.answer = leave
    code, output = shoot('pw --namespace /leaving')
    assert code == 1
    assert output.splitlines()[1:] == ['shoot: the sim went away before the shot ended']


def test_an_interrupt_ends_the_wait_without_a_traceback(start, scripted):
    scripted('/long').answer = lambda number: {'velocity': [0.0, 0.0, 1.0]}
    process = start('cli.shoot', 'pw', '--timeout', '60', '--namespace', '/long')
    process.wait_for('pw: 102.0 mph')
    assert process.stop(signal.SIGINT) == 130
    assert 'Traceback' not in process.output


@pytest.mark.parametrize(
    'arguments, topic',
    [
        ('', '/shot'),
        ('--ball red', '/red/shot'),
        ('--namespace /range', '/range/shot'),
        ('--ball red --namespace range', '/range/red/shot'),
        ('--ros-args -r __ns:=/links', '/links/shot'),
        ('--ros-args -r shot:=/elsewhere', '/elsewhere'),
    ],
)
def test_print_needs_no_sim_and_knows_namespace_and_remappings(shoot, arguments, topic):
    code, output = shoot(f'driver --print {arguments}')
    assert code == 0
    assert output.startswith(f"ros2 topic pub --once {topic} geometry_msgs/msg/Twist '{{linear: ")
    assert output.count('\n') == 1


@pytest.mark.parametrize(
    'arguments', ['--ros-args -r broken', '--ros-args --unknown-option', 'niblick', 'putter']
)
def test_wrong_arguments_exit_with_two_and_no_traceback(shoot, arguments):
    code, output = shoot(f'driver {arguments}')
    assert code == 2
    assert 'shoot: ' in output and 'Traceback' not in output


def test_a_namespace_that_is_none_exits_with_one_line(shoot):
    code, output = shoot('driver --print --namespace 1+1')
    assert code == 1
    assert output.startswith('shoot: Invalid namespace') and output.count('\n') == 1


def test_what_is_printed_is_what_is_struck_to_the_bit(shoot, scripted):
    sim = scripted('/bits')
    shot = '7i --azimuth 3.3 --axis -7.7 --namespace /bits'
    assert shoot(shot)[0] == 0
    message = yaml.safe_load(shoot(f'{shot} --print')[1].split("'")[1])
    velocity, spin = (tuple(message[part].values()) for part in ('linear', 'angular'))
    assert sim.struck == [(velocity, spin)]


@pytest.mark.parametrize('where, ball', [('/aim', ''), ('/aim_red', '--ball red')])
def test_aim_turns_the_target_to_the_hole_from_where_the_ball_lies(shoot, scripted, where, ball):
    sim = scripted(where, ball='red' if ball else 'ball', hole=(40.0, 60.0))
    for azimuth in (0.0, 2.0):
        code, output = shoot(f'pw --aim hole --azimuth {azimuth} --namespace {where} {ball}')
        assert code == 0
        assert f'to the hole: {50.0 / YARD:.2f} yd\n' in output
    directions = [degrees(atan2(y, x)) for (x, y, _), _ in sim.struck]
    to_hole = degrees(atan2(40.0, 30.0))
    assert directions == pytest.approx([to_hole, to_hole - 2.0])
    assert hypot(*sim.struck[0][0]) == pytest.approx(102.0 * MPH)


def test_backspin_stays_backspin_when_the_shot_is_aimed(shoot, scripted):
    sim = scripted('/aim_spin', hole=(10.0, 60.0))
    assert shoot('pw --aim hole --namespace /aim_spin')[0] == 0
    (x, y, _), (spin_x, spin_y, spin_z) = sim.struck[0]
    assert x == pytest.approx(0.0, abs=1e-12) and y > 0.0
    assert spin_x > 0.0 and (spin_y, spin_z) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_aiming_on_a_course_without_a_hole_exits_with_one(shoot, scripted):
    scripted('/endless')
    assert shoot('pw --aim hole --namespace /endless') == (
        1,
        'shoot: this course has no hole to aim at\n',
    )


def test_aiming_with_a_ball_of_another_name_exits_with_one_and_a_hint(shoot, scripted):
    scripted('/named', ball='red', hole=(40.0, 60.0))
    code, output = shoot('pw --aim hole --namespace /named --timeout 6')
    assert code == 1
    assert output == 'shoot: no ball on /named/ball/pose; name the one to strike with --ball\n'


@pytest.fixture(scope='module')
def real_sim(start):
    """Start the real sim, in the namespace /real."""
    process = start('sim_node', *parameters('/real', real_time_factor=8.0))
    process.wait_for('ready')
    return process


@pytest.fixture
def golfer(real_sim, make_golfer):
    """Make a client beside the real sim, whose ball is on the tee."""
    golfer = make_golfer('/real')
    golfer.reset()
    return golfer


def test_the_real_sim_plays_a_shot_and_the_table_is_its_result(shoot, golfer):
    before = place(golfer.poses[-1])
    code, output = shoot('pw --power 0.4 --units si --namespace /real')
    assert code == 0
    wait_until(lambda: golfer.results, 'the result came')
    result = json.loads(golfer.results[-1].data)
    assert result['status'] == 'at_rest' and result['position'][0] > before[0] + 5.0
    for label, unit in (('carry', 'm'), ('total', 'm'), ('duration', 's')):
        assert f'{label:<15}{result[label]:8.2f} {unit}\n' in output


@pytest.mark.parametrize('axis, sign', [(30, -1.0), (-30, 1.0)])
def test_a_ball_with_its_spin_axis_tilted_to_the_right_curves_to_the_right(
    shoot, golfer, axis, sign
):
    assert shoot(f'pw --power 0.5 --axis {axis} --namespace /real')[0] == 0
    wait_until(lambda: golfer.results, 'the result came')
    assert sign * json.loads(golfer.results[-1].data)['carry_side'] > 0.5


def test_a_putt_on_the_real_sim_never_leaves_the_ground(shoot, golfer):
    code, output = shoot('putter --speed 4 --namespace /real')
    assert code == 0
    assert 'carry' not in output and 'total' in output


def test_a_shot_at_the_real_sims_hole_goes_towards_its_marker(shoot, golfer):
    courses = golfer.listen(MarkerArray, 'course/markers', LATCHED)
    wait_until(lambda: courses, 'the course came')
    hole = next(
        one.pose.position for one in courses[-1].markers if (one.ns, one.id) == ('hole', 0)
    )
    x, y, _ = place(golfer.poses[-1])
    heading = atan2(hole.y - y, hole.x - x)
    code, _ = shoot('putter --speed 5 --aim hole --azimuth 1 --namespace /real')
    assert code == 0
    wait_until(lambda: golfer.results, 'the result came')
    velocity = json.loads(golfer.results[-1].data)['velocity']
    direction = heading - radians(1.0)
    assert velocity == pytest.approx(
        [5 * MPH * cos(direction), 5 * MPH * sin(direction), 0.0], abs=1e-3
    )


def test_a_putt_of_3_m_can_be_holed_and_the_result_says_so(shoot, start, make_golfer):
    start(
        'sim_node', *parameters('/green', course='putting_green', real_time_factor=8.0)
    ).wait_for('ready')
    golfer = make_golfer('/green')
    code, output = shoot('putter --units si --speed 2.6 --azimuth -3.7 --namespace /green')
    assert code == 0
    assert 'ended          in the hole' in output
    wait_until(lambda: golfer.results, 'the result came')
    result = json.loads(golfer.results[-1].data)
    assert result['status'] == 'holed'
    assert result['to_hole'] < 0.054
    x, y, z = place(golfer.poses[-1])
    assert hypot(x - 3.0, y) < 0.054 and z < result['position'][2] + 1e-3


def test_a_ball_in_motion_rejects_the_next_shot(start, golfer):
    rest = place(golfer.poses[-1])
    golfer.strike((5.0, 0.0, 40.0))
    wait_until(lambda: place(golfer.poses[-1]) != rest, 'the ball moves')
    # so that it still does then
    golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=True))
    second = start('cli.shoot', 'pw', '--timeout', '60', '--namespace', '/real')
    second.wait_for('pw: 102.0 mph')
    golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=False))
    assert second.wait() == 1
    assert second.lines[-1].startswith('shoot: rejected: ')


def test_a_shot_too_fast_for_golf_is_rejected_with_the_sims_reason(shoot, golfer):
    code, output = shoot('--units si --speed 151 --namespace /real')
    assert code == 1
    assert output.splitlines()[-1].startswith('shoot: rejected: ')
