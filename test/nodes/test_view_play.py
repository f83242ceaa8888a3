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

"""The page's server beside a sim: it follows, publishes nothing, refuses strangers, ends."""

import asyncio
import os
from pathlib import Path
import signal
import socket
from types import SimpleNamespace
from unittest.mock import MagicMock

from geometry_msgs.msg import Twist
from golf_sim_ros.cli import play_hole
from golf_sim_ros.course import load_course
from processes import LASTING, parameters, wait_until
import pytest
from std_msgs.msg import String

pytest.importorskip('nicegui')

import aiohttp  # noqa: E402, I100
from golf_sim_ros.view import server  # noqa: E402
from page_server import listening, served  # noqa: E402

DRIVE = (60.0, 1.0, 14.0), (0.0, -250.0, 0.0)
PUTT = (2.0, 0.1, 0.0)


@pytest.fixture(scope='module')
def sim(start):
    """Start a sim on links, in a namespace of its own."""
    return start('sim_node', *parameters('/viewed', course='links', balls='[red,blue]'))


@pytest.fixture(scope='module')
def url(start, sim):
    """Serve a page of that sim."""
    return served(start, 'cli.view_play', '--namespace', '/viewed')[1]


def status(url, headers, path='/', kind='get'):
    """HTTP status of a request with these headers, of a websocket where `kind` says so."""

    async def ask():
        async with aiohttp.ClientSession() as session:
            if kind == 'get':
                async with session.get(url + path, headers=headers) as answer:
                    return answer.status
            try:
                async with session.ws_connect(url + path, headers=headers):
                    return 101
            except aiohttp.WSServerHandshakeError as error:
                return error.status

    return asyncio.run(ask())


def test_two_pages_see_a_strike_its_poses_and_its_result(url, make_golfer):
    golfer = make_golfer('/viewed', 'red')
    with listening(url) as one, listening(url) as other:
        for page in (one, other):
            page.wait_for('wind')  # the first that is told after the course was drawn
        before = [len(page.of('result')) for page in (one, other)]
        golfer.strike(*DRIVE)
        for page, count in zip((one, other), before):
            result = page.wait_for('result', count + 1)
            assert result['status'] == 'at_rest' and result['ball'] == 'red'
            assert page.of('strike')[-1]['ball'] == 0
            assert 50 < len(page.poses) < 600
            assert page.bytes < 30_000  # course, status, scores and one drive
    own = wait_until(lambda: golfer.results_of(*DRIVE), 'the result came here, too')
    assert {key: result[key] for key in own[-1]} == own[-1]


def test_who_comes_late_gets_the_last_result_and_the_trail(url):
    with listening(url) as page:
        assert page.wait_for('result')['ball'] == 'red'
        wait_until(lambda: len(page.poses) > 20, 'the trail came')


def test_foreign_texts_on_the_sims_topics_change_nothing(url, client, make_golfer):
    golfer = make_golfer('/viewed', 'red')
    with listening(url) as page:
        page.wait_for('wind')
        before = len(page.of('result'))
        for topic in ('heartbeat', 'shot/result', 'journal'):
            foreign = client.publisher(String, f'/viewed/{topic}', LASTING)
            for text in ('hi', '7', '{}', '{"session": 1}'):
                foreign.publish(String(data=text))
        golfer.strike(PUTT)
        assert page.wait_for('result', before + 1)['velocity'] == list(PUTT)


@pytest.mark.parametrize(
    'path, kind',
    [('/', 'get'), ('/feed', 'ws'), ('/_nicegui_ws/socket.io/?EIO=4&transport=websocket', 'ws')],
)
@pytest.mark.parametrize(
    'name, value',
    [('Origin', 'http://evil.example'), ('Host', 'evil.example'), ('Origin', 'null')],
)
def test_strangers_get_403(url, path, kind, name, value):
    assert status(url, {name: value}, path, kind) == 403
    assert status(url, {'Origin': url}, path, kind) != 403


def test_it_listens_on_this_machine_only(url):
    port = int(url.rpartition(':')[2])
    others = {
        info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)
    }
    for other in others - {'127.0.0.1', '127.0.1.1'}:
        with socket.socket() as probe:
            assert probe.connect_ex((other, port)) != 0


def test_view_play_publishes_nothing_whatever_it_is_sent(url, client):
    def found():
        nodes = client.node.get_node_names_and_namespaces()
        return [pair for pair in nodes if pair[0].startswith('view_play') and pair[1] == '/viewed']

    (node,) = wait_until(found, 'view_play is on the graph')
    topics = client.node.get_publisher_names_and_types_by_node(*node)
    assert {topic for topic, _ in topics} <= {'/parameter_events', '/rosout'}
    shots = client.listen(Twist, '/viewed/shot')

    async def shout():
        async with aiohttp.ClientSession() as session:
            async with session.ws_connect(f'{url}/feed') as feed:
                for text in ('strike', '{"kind": "strike"}', 'x' * 10_000):
                    await feed.send_str(text)
                await feed.send_bytes(b'\0' * 1000)
            for path in ('/strike', '/shot', '/feed'):
                await session.post(f'{url}{path}', data='strike')

    asyncio.run(shout())
    with listening(url) as page:
        page.wait_for('course')
    assert not shots


def test_a_sim_that_is_killed_is_told_of_and_its_successor_is_followed(start, make_golfer):
    first = start('sim_node', *parameters('/mortal', course='links', publish_clock='true'))
    _, url = served(start, 'cli.view_play', '--namespace', '/mortal')
    with listening(url) as page:
        page.wait_for('course')
        wait_until(lambda: page.of('status')[-1]['reached'], 'it is reached')
        first.popen.send_signal(signal.SIGKILL)
        wait_until(lambda: not page.of('status')[-1]['reached'], 'it is lost')
        assert 'cannot be reached' in page.of('status')[-1]['text']
        # Its simulated time, too, begins at a ROS time of 0.
        start('sim_node', *parameters('/mortal', course='putting_green', publish_clock='true'))
        page.wait_for('course', 2)
        wait_until(lambda: page.of('status')[-1]['reached'], 'it is back')
        assert page.of('course')[0] != page.of('course')[-1]
        wait_until(lambda: page.poses, 'its ball is seen')


def test_a_browser_that_does_not_read_is_dropped_and_others_go_on(start, make_golfer):
    start(
        'sim_node', *parameters('/flood', course='links', publish_rate=250.0, real_time_factor=5.0)
    )
    _, url = served(start, 'cli.view_play', '--namespace', '/flood')
    golfer = make_golfer('/flood')
    with listening(url) as page:
        page.wait_for('course')
        with socket.create_connection(('127.0.0.1', int(url.rpartition(':')[2]))) as silent:
            silent.sendall(
                f'GET /feed HTTP/1.1\r\nHost: {url[7:]}\r\nUpgrade: websocket\r\n'
                'Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n'
                'Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n'.encode()
            )
            golfer.strike(*DRIVE)
            page.wait_for('result')
        golfer.strike(PUTT)
        page.wait_for('result', 2)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('command', [('cli.view_play',), ('cli.play_hole', 'putting_green')])
def test_a_signal_ends_it_with_0_and_leaves_nothing(start, number, command):
    process, url = served(start, *command)
    with listening(url) as page:
        if len(command) > 1:
            wait_until(lambda: page.of('status')[-1]['reached'], 'its sim is there')
            assert left_of(process.pid)
        assert process.stop(number) == 0
    assert 'Traceback' not in process.output
    assert not left_of(process.pid)


def left_of(pid):
    """Find the sim's processes that process `pid` has started for itself."""
    found = []
    for line in Path('/proc').glob('[0-9]*/cmdline'):
        try:
            words = line.read_bytes().split(b'\0')
        except OSError:
            continue
        found += [line.parent.name] * (f'__ns:=/play_hole_{pid}'.encode() in words)
    return found


def test_a_course_is_played_whatever_is_in_its_path(start, tmp_path):
    course = tmp_path / 'hole #1: grün.yaml'
    ground = '[{shape: plane, material: green}]'
    course.write_text(f'format: 1\nname: First\nhole: [90, 0]\nground: {ground}\n')
    process = start('cli.play_hole', str(course), '--terminal', '--demo', '--wind', '0')
    process.wait_for('First: par')


def test_two_clicks_on_play_on_begin_one_hole():
    game = play_hole.Game(play_hole.parser().parse_args(['links', 'tall_pines']))
    started = []
    game.own = SimpleNamespace(start=started.append)
    for name, again in (('links', 'tall_pines'), ('tall_pines', 'links')):
        game.session.round.begin(load_course(name))

        async def click_twice():
            await asyncio.gather(game.go_on(), game.go_on())
            await game.go_on()  # the next hole's sim is not heard of yet

        asyncio.run(click_twice())
        assert started.pop() == again and not started


def test_the_demonstration_holes_out_in_the_terminal(start):
    process = start(
        'cli.play_hole',
        'putting_green',
        '--terminal',
        '--demo',
        '--wind',
        '0',
        '--real-time-factor',
        '4',
    )
    assert process.wait() == 0
    assert 'Putting green: ' in process.output.splitlines()[-1]


@pytest.mark.parametrize('program', [b'sim_node', b'wind_node'])
def test_an_own_process_that_dies_ends_the_terminal_with_one_line_and_code_1(start, program):
    process = start('cli.play_hole', 'links', '--terminal', '--demo')
    process.wait_for('Links: par 4')
    for pid in left_of(process.pid):
        if program in Path(f'/proc/{pid}/cmdline').read_bytes():
            os.kill(int(pid), signal.SIGKILL)
    assert process.wait() == 1
    told = f'play_hole: {program.decode()} has ended by itself, with code -9'
    assert process.output.splitlines()[-1] == told
    assert not left_of(process.pid)


def test_what_cannot_be_played_or_seen_is_one_line(start):
    for command, arguments, told in (
        ('play_hole', ('nowhere',), 'nowhere'),
        ('play_hole', ('links', '--namespace', '/x'), 'name none'),
        ('play_hole', ('--namespace', 'a b'), 'Invalid namespace'),
        ('play_hole', ('--terminal', '--namespace', 'a b'), 'Invalid namespace'),
        ('play_hole', ('--host', 'nowhere.invalid'), 'nowhere.invalid: '),
        ('view_play', ('--namespace', 'a b'), 'Invalid namespace'),
    ):
        process = start(f'cli.{command}', *arguments)
        assert process.wait() == 1
        assert told in process.output and len(process.output.splitlines()) == 1
        assert 'no port' not in process.output


@pytest.mark.parametrize('command', [('cli.view_play',), ('cli.play_hole', 'putting_green')])
def test_a_link_that_fails_ends_it_with_one_line_and_code_1(start, command):
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv('PYTEST_CURRENT_TEST', raising=False)
        process = start(*command, environment={'ROS_DOMAIN_ID': 'abc'})
    assert process.wait() == 1
    assert 'ROS_DOMAIN_ID' in process.output and len(process.output.splitlines()) == 1
    assert not left_of(process.pid)


@pytest.mark.parametrize('port', ['-1', '65536', '70000', 'http', '8e3'])
def test_what_is_no_port_is_refused(port, capsys):
    with pytest.raises(SystemExit) as ended:
        play_hole.main([f'--port={port}'])
    assert ended.value.code == 2
    assert f'{port!r} is no port: 0 to 65535' in capsys.readouterr().err


def test_a_server_that_fails_closes_what_it_was_for(monkeypatch):
    def fail(**options):
        raise OverflowError('this is no port')

    closed = []
    monkeypatch.setattr(server.ui, 'run', fail)
    monkeypatch.setattr(server, 'app', MagicMock())
    monkeypatch.setattr(server.signal, 'signal', lambda *_: None)
    with pytest.raises(OverflowError):
        server.run(server.Place(), 'x', print, print, lambda: closed.append(True))
    assert closed
