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

"""Where compiled code is read and written: never where somebody else can have put it."""

from contextlib import contextmanager
import os
from pathlib import Path
import resource
import shutil
import stat
import subprocess
import sys
import tempfile

from golf_sim_ros.physics.jit import cache
import pytest

SOMEBODY, ANOTHER = 65534, 54321
is_root = os.geteuid() == 0
as_root = pytest.mark.skipif(not is_root, reason='only root can be several users')
VARIABLES = ('GOLF_SIM_ROS_CACHE', 'NUMBA_CACHE_DIR', 'XDG_CACHE_HOME')


@pytest.fixture
def place(monkeypatch):
    """Make a folder that all can enter, with a home and a place for temporary files.

    The environment says so.
    """
    top = Path(tempfile.mkdtemp(prefix='cache_of_')).resolve()
    top.chmod(0o755)
    made(top / 'home', 0o755)
    made(top / 'tmp', 0o1777)
    for variable in VARIABLES:
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv('HOME', str(top / 'home'))
    monkeypatch.setenv('TMPDIR', str(top / 'tmp'))
    yield top
    shutil.rmtree(top)


def made(path, mode=0o755, owner=None):
    """`position_coefficients` as a folder of that mode and owner, whatever the umask."""
    path.mkdir(parents=True, exist_ok=True)
    path.chmod(mode)
    if owner is not None:
        os.chown(path, owner, owner)
    return path


def kept(folder, owner=None, mode=0o644):
    """Make a file of compiled code in `folder`, which is made, too."""
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / 'flight.nbi'
    file.write_bytes(b'code')
    file.chmod(mode)
    if owner is not None:
        os.chown(file, owner, owner)
    return file


@contextmanager
def running_as(user):
    """Run as another user."""
    groups = os.getgroups()
    os.setgroups([])
    os.setegid(user)
    os.seteuid(user)
    try:
        yield
    finally:
        os.seteuid(0)
        os.setegid(0)
        os.setgroups(groups)


def everything(top):
    """All paths below a folder."""
    return sorted(str(path.relative_to(top)) for path in top.rglob('*'))


def keyed(path):
    return path / cache.source_key()


def mode_of(path):
    return stat.S_IMODE(path.stat().st_mode)


# Where it is


def test_the_cache_is_in_the_home_and_only_its_user_can_enter_it(place):
    found = cache.folder()
    assert found == (keyed(place / 'home/.cache/golf_sim_ros'), True, '')
    assert (
        mode_of(found.path)
        == mode_of(found.path.parent)
        == mode_of(place / 'home/.cache')
        == 0o700
    )


def test_asking_twice_makes_nothing_more(place):
    first = cache.folder()
    before = everything(place)
    assert cache.folder() == first and everything(place) == before


def test_modes_do_not_follow_the_umask(place):
    old = os.umask(0)
    try:
        found = cache.folder()
    finally:
        os.umask(old)
    assert mode_of(found.path) == 0o700 and found.writable


def test_files_written_with_umask_0_where_nobody_can_enter_are_trusted(place):
    kept(cache.folder().path, mode=0o666)
    assert cache.folder().writable and not cache.folder().reason


def test_a_cache_home_is_preferred_to_the_home(place, monkeypatch):
    monkeypatch.setenv('XDG_CACHE_HOME', str(place / 'xdg'))
    assert cache.folder() == (keyed(place / 'xdg/golf_sim_ros'), True, '')


def test_a_relative_cache_home_is_ignored_as_its_specification_says(place, monkeypatch):
    monkeypatch.setenv('XDG_CACHE_HOME', 'xdg')
    assert cache.folder().path == keyed(place / 'home/.cache/golf_sim_ros')


def test_the_variable_of_this_package_comes_first(place, monkeypatch):
    monkeypatch.setenv('XDG_CACHE_HOME', str(place / 'xdg'))
    monkeypatch.setenv('NUMBA_CACHE_DIR', str(place / 'numba'))
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'some/where'))
    assert cache.folder() == (keyed(place / 'some/where'), True, '')
    assert not (place / 'numba').exists()


def test_numbas_variable_means_what_numba_says(place, monkeypatch):
    monkeypatch.setenv('NUMBA_CACHE_DIR', str(place / 'numba'))
    assert cache.folder() == (place / 'numba', True, '')


def test_empty_variables_are_none(place, monkeypatch):
    for variable in VARIABLES:
        monkeypatch.setenv(variable, '')
    assert cache.folder().path == keyed(place / 'home/.cache/golf_sim_ros')


def test_a_relative_path_begins_where_the_process_runs(place, monkeypatch):
    monkeypatch.chdir(made(place / 'here'))
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', 'below')
    assert cache.folder() == (keyed(place / 'here/below'), True, '')


def test_a_relative_path_where_the_working_folder_is_gone_is_told(place, monkeypatch):
    monkeypatch.chdir(made(place / 'gone'))
    (place / 'gone').rmdir()
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', 'below')
    assert is_refused(cache.folder(), 'GOLF_SIM_ROS_CACHE', 'No such file')


# The home


def test_a_home_in_the_variable_is_filled_in(place, monkeypatch):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', '~/code')
    assert cache.folder().path == keyed(place / 'home/code')


@pytest.mark.parametrize('home', [None, '', 'relative', '~'])
def test_without_a_home_there_is_no_folder_named_tilde(place, monkeypatch, home):
    monkeypatch.chdir(made(place / 'here'))
    monkeypatch.setattr(os.path, 'expanduser', without_passwd)
    monkeypatch.setenv('HOME', home) if home is not None else monkeypatch.delenv('HOME')
    found = cache.folder()
    assert found.path == keyed(place / f'tmp/golf_sim_ros_{os.geteuid()}')
    assert found.writable and found.reason == 'there is no home'
    assert everything(place / 'here') == []


def without_passwd(path):
    """os.path.expanduser, where the user has no entry in passwd."""
    home = os.environ.get('HOME')
    return path if home is None or not path.startswith('~') else home + path[1:]


def test_a_variable_that_begins_with_a_home_that_is_none_is_told(place, monkeypatch):
    monkeypatch.chdir(made(place / 'here'))
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', '~who_is_that/cache')
    assert is_refused(cache.folder(), 'GOLF_SIM_ROS_CACHE', 'no such home')
    assert everything(place / 'here') == []


@as_root
def test_a_user_without_passwd_entry_and_home_is_served(place, monkeypatch):
    monkeypatch.delenv('HOME')
    monkeypatch.chdir(made(place / 'here', 0o755, ANOTHER))
    with running_as(ANOTHER):
        monkeypatch.setattr(os, 'getuid', os.geteuid)  # expanduser asks for that one
        found = cache.folder()
    assert found == (keyed(place / f'tmp/golf_sim_ros_{ANOTHER}'), True, 'there is no home')
    assert everything(place / 'here') == []


def test_a_home_that_does_not_exist_is_not_made(place, monkeypatch):
    monkeypatch.setenv('HOME', str(place / 'nowhere'))
    found = cache.folder()
    assert found.writable and 'nowhere does not exist' in found.reason
    assert found.path.parent.parent == place / 'tmp' and not (place / 'nowhere').exists()


@as_root
def test_root_with_the_home_of_another_user_leaves_it_alone(place):
    made(place / 'home', 0o755, SOMEBODY)
    found = cache.folder()
    assert found.path == keyed(place / 'tmp/golf_sim_ros_0') and found.writable
    assert f'{place}/home belongs to another user ({SOMEBODY})' in found.reason
    assert everything(place / 'home') == []


@pytest.mark.parametrize('mode', [0o777, 0o775, 0o757])
def test_a_home_that_others_can_write_is_not_used(place, mode):
    made(place / 'home', mode)
    found = cache.folder()
    assert found.path.parent.parent == place / 'tmp'
    assert 'home can be written by others' in found.reason and everything(place / 'home') == []


def test_a_sticky_home_is_as_safe_as_the_folder_for_temporary_files(place):
    made(place / 'home', 0o1777)
    assert cache.folder() == (keyed(place / 'home/.cache/golf_sim_ros'), True, '')


# Who can have written there


@pytest.mark.parametrize('mode', [0o720, 0o702, 0o777, 0o1777])
def test_a_folder_that_others_can_write_is_refused(place, monkeypatch, mode):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'code'))
    made(keyed(place / 'code'), mode)
    assert is_refused(cache.folder(), f'{keyed(place / "code")} can be written by others')


@pytest.mark.parametrize('mode', [0o720, 0o702, 0o777])
def test_a_folder_in_one_that_others_can_write_is_refused(place, monkeypatch, mode):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'open/code'))
    kept(keyed(place / 'open/code'))
    made(place / 'open', mode)
    assert is_refused(cache.folder(), f'{place}/open can be written by others')


@pytest.mark.parametrize('mode', [0o666, 0o664, 0o646])
def test_a_file_that_others_can_write_is_refused(place, monkeypatch, mode):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'code'))
    kept(keyed(place / 'code') / 'effects', mode=mode)
    made(keyed(place / 'code'), 0o755)
    assert is_refused(cache.folder(), 'flight.nbi can be written by others')


def test_a_folder_in_it_that_others_can_write_is_refused(place, monkeypatch):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'code'))
    made(keyed(place / 'code') / 'effects', 0o777)
    made(keyed(place / 'code'), 0o755)
    assert is_refused(cache.folder(), 'effects can be written by others')


@as_root
@pytest.mark.parametrize('owned', ['.', '..', '../..'])
def test_a_folder_of_another_user_or_in_one_is_refused(place, monkeypatch, owned):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'his/code'))
    kept(keyed(place / 'his/code'))
    os.chown(keyed(place / 'his/code') / owned, ANOTHER, ANOTHER)
    assert is_refused(cache.folder(), f'belongs to another user ({ANOTHER})')
    with running_as(SOMEBODY):
        assert is_refused(cache.folder(), f'belongs to another user ({ANOTHER})')


@as_root
def test_a_file_of_another_user_is_refused(place, monkeypatch):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'code'))
    kept(keyed(place / 'code'), owner=ANOTHER, mode=0o600)
    assert is_refused(cache.folder(), f'flight.nbi belongs to another user ({ANOTHER})')


@as_root
@pytest.mark.parametrize('name', ['golf_sim_ros', 'golf_sim_ros_65534'])
def test_what_another_user_put_into_the_temporary_folder_is_not_taken(place, monkeypatch, name):
    monkeypatch.delenv('HOME')
    kept(keyed(place / 'tmp' / name), owner=ANOTHER)
    for path in (place / 'tmp' / name, keyed(place / 'tmp' / name)):
        made(path, 0o755, ANOTHER)
    monkeypatch.setenv('HOME', '/nonexistent')
    with running_as(SOMEBODY):
        found = cache.folder()
    own = keyed(place / f'tmp/golf_sim_ros_{SOMEBODY}')
    assert found.path == (own if name == 'golf_sim_ros' else None)
    assert name == 'golf_sim_ros' or f'belongs to another user ({ANOTHER})' in found.reason


# Reading without writing


@as_root
def test_a_cache_of_root_is_read_in_place_by_a_user_who_cannot_write_it(place, monkeypatch):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'image'))
    kept(made(keyed(place / 'image')))
    before = everything(place)
    with running_as(1000):
        found = cache.folder()
    assert found.path == keyed(place / 'image') and not found.writable
    assert 'Permission denied' in found.reason and everything(place) == before


@as_root
def test_root_may_share_what_it_compiled_by_opening_it_for_reading(place, monkeypatch):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'image'))
    kept(cache.folder().path, mode=0o600)
    with running_as(1000):
        assert is_refused(cache.folder(), 'Permission denied')
    subprocess.run(['chmod', '-R', 'a+rX,go-w', place / 'image'], check=True)
    with running_as(1000):
        assert cache.folder().path == keyed(place / 'image')


@as_root
def test_an_empty_cache_that_cannot_be_written_is_none(place, monkeypatch):
    made(keyed(place / 'image'))
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'image'))
    with running_as(1000):
        assert is_refused(cache.folder(), 'Permission denied')


@as_root
def test_a_cache_for_other_sources_that_cannot_be_written_is_none(place, monkeypatch):
    kept(made(place / 'image' / 'other_sources'))
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'image'))
    with running_as(1000):
        assert is_refused(cache.folder(), 'Permission denied')


@as_root
def test_nothing_writable_and_nothing_to_read_is_none_in_one_line(place, monkeypatch):
    made(place / 'tmp', 0o755)
    before = everything(place)
    with running_as(SOMEBODY):
        assert is_refused(
            cache.folder(), 'no folder for compiled code', 'home', 'tmp', 'Permission denied'
        )
    assert everything(place) == before


@as_root
def test_a_read_only_file_system_is_read(place, monkeypatch):
    """Not by its mode, which root would not heed."""
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'image'))
    kept(made(keyed(place / 'image')))
    told = in_a_mount(f'--bind -o ro {place}/image', place / 'image')
    assert told.startswith('kept unwritable') and 'Read-only file system' in told


# What goes wrong


def test_a_full_disk_is_read_and_not_written(place, monkeypatch):
    kept(cache.folder().path)
    for free in (0, 4096):  # that not even part of it fits, and that part of it does
        with at_most(free):
            found = cache.folder()
        assert found.path == keyed(place / 'home/.cache/golf_sim_ros') and not found.writable
        assert found.reason.startswith(f'{found.path}: ')


def test_a_full_disk_without_anything_to_read_is_none(place, monkeypatch):
    with at_most(0):
        assert is_refused(cache.folder(), 'no folder for compiled code', 'File too large')


@contextmanager
def at_most(size):
    """No file of this process can get larger than `size` bytes."""
    old = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, old[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, old)


@as_root
def test_a_disk_that_is_full_is_told(place, monkeypatch):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'small'))
    made(place / 'small')
    told = in_a_mount('-t tmpfs -o size=4k,mode=755 tmpfs', place / 'small')
    assert told.startswith('none') and ('No space left' in told or 'no room' in told)


def in_a_mount(source, where):
    """Mount `source`, arguments of mount, at `where`: what a process says that sees it there."""
    said = subprocess.run(
        [
            'unshare',
            '--mount',
            'sh',
            '-c',
            f'mount {source} {where} && exec "$@"',
            'sh',
            sys.executable,
            '-c',
            TELL,
            cache.__file__,
        ],
        text=True,
        capture_output=True,
    )
    if 'mount:' in said.stderr or 'unshare:' in said.stderr:
        pytest.skip(f'nothing can be mounted here: {said.stderr.strip()}')
    assert not said.returncode, said.stderr
    return said.stdout


TELL = """
import importlib.util, sys
spec = importlib.util.spec_from_file_location('cache', sys.argv[1])
cache = importlib.util.module_from_spec(spec)
spec.loader.exec_module(cache)
cache.source_key = lambda: %r
found = cache.folder()
print('kept' if found.path else 'none', 'writable' if found.writable else 'unwritable',
      found.path, found.reason)
""" % cache.source_key()


@pytest.mark.parametrize('file', ['code', 'code/key'])
def test_a_file_where_the_folder_should_be_is_told(place, monkeypatch, file):
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'code'))
    file = place / 'code' if file == 'code' else keyed(place / 'code')
    file.parent.mkdir(exist_ok=True)
    file.write_text('a file')
    assert is_refused(cache.folder(), 'GOLF_SIM_ROS_CACHE', f'{file} is no folder')
    assert file.read_text() == 'a file'


def test_a_file_where_the_users_cache_should_be_costs_only_that_place(place):
    (place / 'home/.cache').write_text('')
    found = cache.folder()
    assert found.path.parent.parent == place / 'tmp' and '.cache is no folder' in found.reason


def test_many_processes_may_make_it_at_once(place):
    told = [
        subprocess.Popen(
            [sys.executable, '-c', TELL, cache.__file__], stdout=subprocess.PIPE, text=True
        )
        for _ in range(8)
    ]
    said = {process.communicate()[0] for process in told}
    assert said == {f'kept writable {keyed(place / "home/.cache/golf_sim_ros")} \n'}


def test_a_folder_that_another_process_makes_meanwhile_is_taken(place, monkeypatch):
    slow = os.mkdir

    def after_another(path, mode):
        slow(path, mode)
        raise FileExistsError(path)

    monkeypatch.setattr(os, 'mkdir', after_another)
    assert cache.folder().writable


def test_a_file_that_is_renamed_meanwhile_does_no_harm(place, monkeypatch):
    kept(cache.folder().path)
    monkeypatch.setattr(
        os, 'walk', lambda top, onerror: [(str(top), [], ['tmp.gone', 'flight.nbi'])]
    )
    assert cache.folder().writable


# Links


def test_a_link_of_ones_own_is_followed(place, monkeypatch):
    made(place / 'disk', 0o700)
    (place / 'home/.cache').symlink_to('../disk')
    found = cache.folder()
    assert found.writable and keyed(place / 'disk/golf_sim_ros').is_dir() and not found.reason


def test_what_a_link_leads_to_has_to_be_safe(place, monkeypatch):
    made(place / 'disk', 0o777)
    (place / 'home/.cache').symlink_to(place / 'disk')
    assert f'{place}/disk can be written by others' in cache.folder().reason
    assert everything(place / 'disk') == []


@as_root
def test_a_link_of_another_user_is_not_followed(place, monkeypatch):
    target, link = made(place / 'target', 0o700), place / 'tmp/link'
    link.symlink_to(target)
    os.chown(link, ANOTHER, ANOTHER, follow_symlinks=False)
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(link))
    assert is_refused(cache.folder(), f'{link} belongs to another user')
    assert everything(target) == []


def test_a_link_in_the_cache_is_refused(place, monkeypatch):
    (cache.folder().path / 'flight.nbi').symlink_to(made(place / 'elsewhere') / 'code')
    assert 'flight.nbi is a link' in cache.folder().reason


@pytest.mark.parametrize('target', ['code', 'nothing'])
def test_a_link_to_itself_or_to_nothing_is_told(place, monkeypatch, target):
    (place / 'code').symlink_to(target)
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(place / 'code'))
    assert is_refused(cache.folder(), 'GOLF_SIM_ROS_CACHE')
    assert not (place / 'nothing').exists()


# Namespaces of users


@as_root
def test_where_root_has_no_number_what_belongs_to_it_is_trusted(place):
    """As in a container that an ordinary user started: the machine's own files are nobody's."""
    python = shutil.which('python3', path='/usr/bin:/bin')
    if not python or not shutil.which('unshare'):
        pytest.skip('needs unshare, and a Python that every user can run')
    for path in (place, place / 'home'):
        os.chown(path, ANOTHER, ANOTHER)
    shutil.copy(cache.__file__, place / 'cache.py')
    (place / 'cache.py').chmod(0o644)
    inside = [python, '-c', TELL, str(place / 'cache.py')]
    said = subprocess.run(
        ['unshare', '--user', '--map-root-user', *inside],
        user=ANOTHER,
        group=ANOTHER,
        extra_groups=[],
        text=True,
        capture_output=True,
        cwd='/',
    )
    if 'unshare:' in said.stderr:
        pytest.skip(f'no namespaces here: {said.stderr.strip()}')
    assert said.stdout == f'kept writable {keyed(place / "home/.cache/golf_sim_ros")} \n', (
        said.stderr
    )


# The key


def test_the_key_follows_every_source_of_the_physics_and_its_name(place, monkeypatch):
    physics = made(place / 'physics/jit').parent
    (physics / 'a.py').write_text('1')
    monkeypatch.setattr(cache, '__file__', str(physics / 'jit/cache.py'))
    keys = [cache.source_key.__wrapped__()]
    for change in ((physics / 'a.py').write_text, (physics / 'jit/b.py').write_text):
        change('2')
        keys.append(cache.source_key.__wrapped__())
    (physics / 'a.py').rename(physics / 'c.py')
    keys.append(cache.source_key.__wrapped__())
    (physics / 'notes.txt').write_text('no source')
    assert len(set(keys)) == 4 and cache.source_key.__wrapped__() == keys[-1]


def test_sources_that_change_while_a_process_runs_do_not_change_its_key(monkeypatch):
    key = cache.source_key()
    monkeypatch.setattr(cache, '__file__', '/nowhere/physics/jit/cache.py')
    assert cache.source_key() == key


def test_finding_the_cache_imports_neither_numba_nor_numpy():
    code = f'{TELL}assert not {{"numba", "numpy", "llvmlite"}} & set(sys.modules)'
    subprocess.run(
        [sys.executable, '-S', '-c', code, cache.__file__], check=True, stdout=subprocess.DEVNULL
    )


def is_refused(found, *reasons):
    """Whether there is no cache, and one line says why."""
    assert found.path is None and not found.writable
    assert all(reason in found.reason for reason in reasons), found.reason
    return '\n' not in found.reason
