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

"""Page and picture of a comparison with a launch monitor."""

from collections.abc import Iterable, Mapping
from math import isnan
from pathlib import Path

import numpy as np

from .errors import bias_and_spread, Comparison, Figures, Group
from ..shot_input.monitor_file import MonitorShots
from ..shot_input.units import Unit

PICTURE, PAGE = 'comparison.png', 'comparison.md'


def cell(errors: np.ndarray, unit: Unit) -> str:
    """Bias and spread as text, or '' where nothing is known."""
    mean, deviation, count = bias_and_spread(errors / unit.size)
    return f'{mean:+.2f} +- {deviation:.2f}' if count else ''


def table(
    heading: str, groups: Iterable[Group], errors: Mapping[str, np.ndarray], shown: Figures
) -> str:
    """Markdown table, a line for each group and law."""
    known = [
        i for i, _ in enumerate(shown) if any(np.isfinite(law[i]).any() for law in errors.values())
    ]
    titles = [f'{shown[i][0]} [{shown[i][1].name}]' for i in known]
    lines = [
        f'| {heading} | shots | law | {" | ".join(titles)} |',
        '|---' * (3 + len(known)) + '|',
    ]
    for label, mask in groups:
        for law, off in errors.items():
            cells = [cell(off[i][mask], shown[i][1]) for i in known]
            lines.append(f'| {safe(label)} | {mask.sum()} | {law} | {" | ".join(cells)} |')
    return '\n'.join(lines)


def safe(text: str) -> str:
    """Text that cannot end a cell of a table."""
    return ' '.join(text.replace('|', '/').split())


def everything(comparison: Comparison) -> list[Group]:
    """`Group` of all shots."""
    return [Group('all', np.ones(len(comparison.ratios), bool))]


def page(
    title: str,
    shots: MonitorShots,
    comparison: Comparison,
    shown: Figures,
    notes: Iterable[str],
    picture: str = PICTURE,
) -> str:
    """Markdown page: what was compared with what, every table, and `picture` if there is one."""
    left = [f'{count} rows {reason}' for reason, count in shots.left_out.items()]
    lines = [
        f'# {safe(title)}: simulated, less told',
        '',
        f'{len(shots.launches)} shots of {shots.monitor.title}, flown from the launch it told. '
        + (f'Left out: {"; ".join(left)}. ' if left else '')
        + ' '.join(notes),
        '',
        f'**What these figures are.** {shots.monitor.carry} '
        'A difference is then one of two models.',
        '',
        'Each cell is the bias, the mean of simulated less told, and the spread, the standard '
        'deviation of a shot about it.',
        '',
        *([f'![Errors of the carry]({picture})', ''] if picture else []),
        table('', everything(comparison), comparison.errors, shown),
    ]
    for heading, groups in comparison.groups.items():
        lines += ['', f'## By {heading}', '', table(heading, groups, comparison.errors, shown)]
    return '\n'.join(lines) + '\n'


def draw(path: Path, comparison: Comparison, shown: Figures) -> None:
    """Draw the errors of the first figure that was told: over the spin ratio, and by group."""
    import matplotlib

    matplotlib.use('Agg')
    from matplotlib import pyplot as plt

    from ..drawing.style import bare, colors

    index = next(
        i
        for i, _ in enumerate(shown)
        if any(np.isfinite(law[i]).any() for law in comparison.errors.values())
    )
    name, unit = shown[index]
    heading, groups = next(iter(comparison.groups.items()))
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2), constrained_layout=True)
    laws = list(comparison.errors.items())
    for number, ((law, errors), color) in enumerate(zip(laws, colors(len(laws)))):
        off = errors[index] / unit.size
        left.plot(comparison.ratios, off, '.', ms=5, alpha=0.7, color=color, label=law)
        biases = [bias_and_spread(off[mask])[:2] for _, mask in groups]
        places = np.arange(len(groups)) + 0.12 * (number - (len(laws) - 1) / 2)
        means, deviations = zip(*((m, d) if not isnan(m) else (0.0, 0.0) for m, d in biases))
        right.errorbar(places, means, deviations, fmt='o', ms=4, capsize=2, color=color)
    for axes in (left, right):
        axes.axhline(0.0, color='k', lw=0.6)
    left.legend(frameon=False, fontsize=8)
    right.set_xticks(range(len(groups)), [label for label, _ in groups], rotation=40, ha='right')
    bare(left, f'{name}: simulated less told', 'spin ratio at launch', unit.name)
    bare(right, f'bias and spread by {heading}', '', unit.name)
    figure.savefig(path, dpi=110)
    plt.close(figure)
