# SPDX-License-Identifier: Apache-2.0
"""How to install a library that only some tools need, said where it is missing."""

# What apt has, on Ubuntu from 22.04 and Debian from 12; rosdep installs it with the rest of package.xml.
APT = {'matplotlib': 'python3-matplotlib', 'scipy': 'python3-scipy', 'tqdm': 'python3-tqdm',
       'rasterio': 'python3-rasterio'}


def how_to_get(extra, *libraries):
    """Ways to install `libraries`, all of which the pip extra `extra` of this package brings."""
    by_pip = f"pip install 'golf_sim_ros[{extra}]'"
    if not APT.keys() >= set(libraries):
        return f'{by_pip} (in a virtual environment; apt has no {" and no ".join(libraries)})'
    packages = ' '.join(APT[library] for library in libraries)
    return f'sudo apt install {packages}, or {by_pip} (in a virtual environment)'
