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

"""Contract of every registered effect: documented, finite, repeatable; absent is as off."""

from itertools import product
from math import isfinite

from driving_range import HARD, level, TURF
from golf_sim_ros.physics import ACCURACY, Air, EFFECTS, register_effect, Shot, simulate, World
from golf_sim_ros.physics.effects import (
    choose,
    effective_normal,
    flight_rates,
    gravity_at,
    LIVE,
    protocol,
    Scene,
)
from golf_sim_ros.physics.engine.engines import missing
from golf_sim_ros.physics.jit import compiled, entry
from golf_sim_ros.physics.scene.kernel_model import build_model, ground
import numpy as np
from other_process import run
import pytest

NO_AIR = Air(pressure=0.0, relative_humidity=0.0)
SCENES = {
    'calm turf': Scene(level(TURF)),
    'hard ground': Scene(level(HARD)),
    'no air': Scene(level(HARD, air=NO_AIR)),
    'wind': Scene(level(TURF), live={'wind': (4.0, -3.0, 0.5)}),
}
SHOT = Shot((30.0, 2.0, 20.0), (50.0, -250.0, 30.0))
effects = pytest.mark.parametrize('name', EFFECTS)
# Effects of what these scenes do not have; that they matter is shown where they are tested.
ELSEWHERE = {'ball_ball', 'foliage', 'turbulence', 'water', 'wind_field'}
CASTS = {'drag': 'Drag', 'magnus': 'Magnus', 'spin_decay': 'SpinDecay', 'turf': 'Turf'}
# The others are left out because one is better, not because they would do nothing.
AUTOMATIC = [name for name in EFFECTS if not EFFECTS[name].instead_of]
ON_REQUEST = [name for name in EFFECTS if EFFECTS[name].instead_of]


def test_the_contract_knows_the_effects_of_the_interface():
    assert {'gravity', 'drag', 'magnus', 'spin_decay', 'wind', 'turf', 'linear_drag'} <= set(
        EFFECTS
    )


def test_effects_that_act_together_have_records_of_different_types():
    kinds = [type(EFFECTS[name].record(SCENES['wind'])) for name in AUTOMATIC]
    assert len(set(kinds)) == len(kinds)


@effects
def test_an_effect_is_documented(name):
    record = EFFECTS[name].record(SCENES['wind'])
    assert (
        EFFECTS[name].doc.endswith('.')
        and len(EFFECTS[name].doc) > 20
        and '\n' not in EFFECTS[name].doc
    )
    doc = type(record).__doc__
    assert not doc.startswith(type(record).__name__ + '('), (
        'has the docstring of a NamedTuple only'
    )


@effects
def test_an_effect_is_a_record_of_finite_numbers(name):
    for scene in SCENES.values():
        for field in EFFECTS[name].record(scene):
            if np.asarray(field).dtype.names is None:  # not a table of what stands on the course
                assert np.isfinite(field).all()


@pytest.fixture(scope='module')
def told():
    """Find what each effect says, differs by, and changes where auto leaves it out.

    From two processes.
    """
    return run(findings), run(findings)


def findings():
    """All of that, by name."""
    return {
        name: {
            'answers': answers(name),
            'said': said(name),
            'difference': difference(name),
            'ends': ends_without_and_with(name),
        }
        for name in EFFECTS
    }


@effects
def test_an_effect_is_finite_and_repeatable(name, told):
    once, again = (process[name]['answers'] for process in told)
    assert once == again
    assert all(isfinite(number) for answer in once for vector in answer for number in vector)
    for *_, normal in once:
        assert np.linalg.norm(normal) == pytest.approx(1.0, abs=1e-12)


@entry
def asked(effect, ground, flow, force):
    """Ask an effect of a flying ball: acceleration, spin rate, longest step."""
    return (
        protocol.acceleration(effect, flow),
        protocol.spin_rate(effect, flow),
        protocol.longest_step(effect, ground, flow, force, 2.0),
    )


def said(name, run=asked):
    """All that of one ball, by `asked` or what it was compiled to."""
    velocity, spin = (40.0, 3.0, 14.0), (20.0, -280.0, 10.0)
    flow = protocol.Flow(
        velocity, float(np.linalg.norm(velocity)), spin, (1.0, 2.0, 30.0), velocity
    )
    scene = SCENES['wind']
    return run(EFFECTS[name].record(scene), ground(scene.course), flow, (-8.0, 0.5, -6.0))


@effects
def test_an_effect_says_the_same_compiled(name, told):
    if missing():
        pytest.skip(missing())
    for machine, plain in zip(said(name, compiled(asked)), told[0][name]['said']):
        assert machine == pytest.approx(plain, rel=1e-12)


def answers(name):
    """Ask an effect alone of many states, extreme too: acceleration, spin rate, pull, normal."""
    told = []
    speeds = (
        (0, 0, 0),
        (1e-9, 0, 0),
        (0.1, 0, -0.1),
        (70, 3, 14),
        (0, 0, -30),
        (0, 0, 30),
        (150, 0, 0),
    )
    spins = ((0, 0, 0), (1e-9, 0, 0), (0, -280, 0), (2500, 0, 0), (3, 4, -1000))
    for scene in SCENES.values():
        model = build_model(scene.course, [EFFECTS[name].record(scene)], ACCURACY['standard'])
        for velocity, spin, height in product(speeds, spins, (0.021335, 40.0)):
            place = (1.0, 2.0, height)
            velocity, spin = tuple(map(float, velocity)), tuple(map(float, spin))
            rates = flight_rates(model.effects, model.land.ground, place, velocity, spin)
            told.append(
                (
                    *rates,
                    gravity_at(model.land.effects, place),
                    effective_normal(model.land.effects, (0.0, 0.0, 1.0), velocity, 1.0),
                )
            )
    return told


@pytest.mark.parametrize('scene', SCENES)
def test_auto_gives_each_effect_or_a_reason(scene):
    on, off, *_ = choose('auto', SCENES[scene])
    assert sorted([*on, *off]) == sorted(AUTOMATIC)
    assert all(reason and '\n' not in reason for reason in off.values())
    assert 'gravity' in on


def test_auto_leaves_out_what_the_scene_has_no_cause_for():
    off = {scene: choose('auto', SCENES[scene]).off for scene in SCENES}
    assert off['calm turf'].keys() == {'wind'} | ELSEWHERE
    assert off['hard ground'].keys() == {'wind', 'turf'} | ELSEWHERE
    assert off['wind'].keys() == ELSEWHERE
    assert off['no air'].keys() >= {'drag', 'magnus', 'spin_decay', 'turf', 'wind'}
    assert off['no air']['drag'] == 'no air' and off['calm turf']['wind'] == 'no wind'
    assert off['hard ground']['turf'] == 'all ground is hard'


@pytest.mark.parametrize('name', AUTOMATIC)
def test_an_effect_that_auto_leaves_out_would_change_nothing(name, told):
    for absent, present in told[0][name]['ends']:
        assert absent == present


def ends_without_and_with(name):
    """End a shot by auto and by auto with `name`, in all scenes where auto leaves it out."""
    pairs = []
    for scene in SCENES.values():
        on, off, *_ = choose('auto', scene)
        if name in off:
            pairs.append([end(scene, effects) for effects in ('auto', (*on, name))])
    return pairs


def end(scene, names):
    """Figures of a shot's end."""
    play = simulate(scene.course, SHOT, effects=names, rate=10.0, **scene.live)
    told = play.result
    return [*told.position, told.carry, told.apex, told.duration, *play.spins[-2]]


@pytest.mark.parametrize('name', [name for name in EFFECTS if name not in ELSEWHERE])
def test_an_effect_that_is_on_matters(name, told):
    assert told[0][name]['difference'] > 0.01


def difference(name):
    """Find how far off [m] a shot in the wind would come to rest, or down, without an effect."""
    scene = SCENES['wind']
    others = [
        other
        for other in choose('auto', scene).on
        if other not in (name, *EFFECTS[name].instead_of)
    ]
    places = []
    for names in ((*others, name), others):
        world = World(scene.course, effects=names, **scene.live)
        world.strike('ball', *SHOT)
        world.advance(30.0)
        places.append(world['ball'].position)
    return float(np.linalg.norm(np.subtract(*places)))


def test_the_order_of_the_names_does_not_matter():
    ends = run(ends_in_orders)
    assert ends[0] == ends[1]


def ends_in_orders():
    """End a shot with the same effects named in two orders."""
    names = ('gravity', 'drag', 'magnus')
    return [end(SCENES['calm turf'], order) for order in (names, names[::-1])]


def test_effects_not_asked_for_are_off_and_say_so():
    on, off, *_ = choose(('gravity', 'drag'), SCENES['wind'])
    assert on.keys() == {'gravity', 'drag'}
    assert set(off.values()) == {'not asked for'}


@pytest.mark.parametrize('scene', SCENES)
def test_what_is_off_is_of_no_type_that_the_kernels_see(scene):
    world = World(SCENES[scene].course, engine='python', **SCENES[scene].live)
    kinds = {
        type(record).__name__ for record in (*world._model.effects, *world._model.land.effects)
    }
    assert {CASTS[name] for name in CASTS if name in world.effects_on} <= kinds
    assert not kinds & {CASTS[name] for name in CASTS if name in world.effects_off}
    assert (
        not kinds
        & {'Drag', 'Magnus', 'SpinDecay'}
        & {type(r).__name__ for r in world._model.land.effects}
    )


def test_a_rolling_ball_evaluates_no_aerodynamics_and_a_resting_one_plans_no_segment():
    flying, rolling, rolled, ends = run(evaluations)
    assert flying > 0 and rolled == rolling and ends == float('inf')


def evaluations():
    """Count evaluations of the rates of flight: of a short flight, of a roll at two times.

    The last number is the end of the rest.
    """
    world, told = World(level(TURF)), []
    for velocity in ((3.0, 0.0, 3.0), (2.0, 0.0, 0.0)):
        world._balls[0]['evaluations'] = 0
        world.strike('ball', velocity)
        world.advance(0.1)
        told.append(int(world._balls[0]['evaluations']))
        world.advance(0.5 if velocity[2] == 0.0 else 60.0)
    told.append(int(world._balls[0]['evaluations']))
    world.advance(60.0)
    return (*told, float(world._balls[0]['end']))


def test_what_was_asked_for_and_the_scene_can_not_have_is_told_with_the_reason():
    asked = ('gravity', 'drag', 'magnus', 'turf', 'ball_ball', 'water', 'wind', 'foliage')
    chosen = choose(asked, SCENES['hard ground'])
    assert chosen.on.keys() == set(asked)  # honoured all the same
    assert chosen.needless == {
        'turf': 'all ground is hard',
        'ball_ball': 'one ball',
        'water': 'no water',
        'foliage': 'no leaves',
    }  # wind may still come
    assert choose('auto', SCENES['hard ground']).needless == {}


def test_an_alternative_is_simulated_only_by_name():
    for name in ON_REQUEST:
        assert EFFECTS[name].instead_of and set(EFFECTS[name].instead_of) <= set(AUTOMATIC)
        assert name in choose(('gravity', name), SCENES['wind']).on


def test_an_unknown_effect_is_named_with_the_known_ones():
    known = 'auto, ball_ball, bearman_harvey_1976, drag'
    with pytest.raises(ValueError, match=f"'snow' is unknown; known: {known}"):
        World(level(TURF), effects=('gravity', 'snow'))


@pytest.mark.parametrize(
    'names, said',
    [
        (('gravity', 'dragg'), "; did you mean 'drag'"),
        (('auto', 'wind'), 'auto stands alone'),
        (('drag', 'ferguson_drag'), "'drag' and 'ferguson_drag' are two laws for the same"),
        (
            ('naruo_2004', 'ferguson_lift'),
            "'naruo_2004' and 'ferguson_lift' are two laws for the same",
        ),
        ('snow', "'snow' is unknown"),
    ],
)
def test_names_that_do_not_go_together_are_refused(names, said):
    with pytest.raises(ValueError, match=said):
        choose(names, SCENES['wind'])


def test_a_name_is_given_only_once():
    with pytest.raises(ValueError, match="'drag' is already registered"):
        register_effect('drag', None, None, '')


def test_another_package_can_add_an_effect():
    plain, heavier = run(ends_with_down_draught)
    assert heavier[3] < plain[3] - 1  # carry


def ends_with_down_draught():
    """End a shot without and with an effect that another package registers."""
    from typing import NamedTuple

    from golf_sim_ros.physics.effects import protocol

    class DownDraught(NamedTuple):
        push: float = 1.0

    protocol.acceleration.register(DownDraught)(lambda effect, flow: (0.0, 0.0, -effect.push))
    register_effect('down_draught', lambda scene: DownDraught(), lambda scene: '', 'Pushes down.')
    return [end(SCENES['calm turf'], ('gravity', *more)) for more in ((), ('down_draught',))]


def test_a_live_parameter_is_set_by_the_name_of_its_effect():
    by_name, as_wind = World(level(TURF)), World(level(TURF))
    by_name.set_live('wind', (3, 4, 0))
    as_wind.set_wind((3, 4, 0))
    assert by_name.live == as_wind.live and by_name.live['wind'] == (3.0, 4.0, 0.0)
    assert by_name.state() == as_wind.state() and by_name.effects_on == as_wind.effects_on
    with pytest.raises(
        ValueError, match="'drag' has nothing that can be set; those that do: .*wind"
    ):
        by_name.set_live('drag', (1.0,))


def test_an_effect_with_a_live_parameter_does_nothing_at_its_default():
    assert 'wind' in LIVE and set(LIVE) <= set(EFFECTS)
    for name, live in LIVE.items():
        assert live.check(live.default) == live.default
        assert EFFECTS[name].idle(Scene(level(TURF))) and EFFECTS[name].dormant


def test_a_keyword_that_no_effect_has_is_refused_with_those_there_are():
    with pytest.raises(TypeError, match="unexpected keyword argument 'acuracy'.*: .*wind"):
        World(level(TURF), acuracy='sketch')
    with pytest.raises(ValueError, match='over 100 m/s'):
        World(level(TURF), wind=(0.0, 0.0, 101.0))
