# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where everything lies in a checkout, and which packages the workspace holds."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

from console import SetupError

WHEELS = 'wheels'
SYSTEM = 'system'
SYSTEM_PREFIX = Path('/opt/ros/jazzy')
# Packages of ROS 2 of which the workspace holds a copy, for where they are absent.
COPIES = ('tf2_msgs',)


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Paths of one checkout.

    Attributes:
        root: Top folder of the checkout, absolute and without links.
        ros: ``wheels`` or ``system``.
        python_tag: ``3.11`` or ``3.12``.
    """

    root: Path
    ros: str
    python_tag: str

    @property
    def venv(self) -> Path:
        """Folder of the virtual environment."""
        return self.root / '.venv'

    @property
    def venv_python(self) -> Path:
        """Interpreter of the virtual environment."""
        return self.venv / 'bin' / 'python'

    @property
    def site_packages(self) -> Path:
        """Where the virtual environment keeps its Python packages."""
        return self.venv / 'lib' / f'python{self.python_tag}' / 'site-packages'

    @property
    def workspace(self) -> Path:
        """The colcon workspace."""
        return self.root / 'ros_ws'

    @property
    def install(self) -> Path:
        """Merged install prefix of the workspace."""
        return self.workspace / 'install'

    @property
    def stamps(self) -> Path:
        """Folder of the stamp files; removed together with the virtual environment."""
        return self.venv / 'aurora_stamps'

    @property
    def logs(self) -> Path:
        """Folder of the logs of set-up; colcon's own lie beside it."""
        return self.workspace / 'log' / 'setup'

    @property
    def run_lock(self) -> Path:
        """Lock with hashes of what build and run need."""
        kind = 'system' if self.ros == SYSTEM else 'run'
        return self.root / 'requirements' / f'{kind}-py{self.python_tag}.txt'

    @property
    def dev_lock(self) -> Path:
        """Lock with hashes of what tests and linters need besides."""
        kind = 'system-dev' if self.ros == SYSTEM else 'dev'
        return self.root / 'requirements' / f'{kind}-py{self.python_tag}.txt'

    def ros_has(self, name: str) -> bool:
        """Whether ROS itself brings a package along: a copy of ours would only hide it."""
        here = SYSTEM_PREFIX / 'share' / name if self.ros == SYSTEM else self.site_packages / name
        return here.is_dir()

    def packages(self) -> dict[str, Path]:
        """Find the workspace's packages, through the links in ``ros_ws/src``.

        Copies of what ROS may lack (`COPIES`) are left out where it does not.

        Returns:
            Folder (without links) by package name, sorted by name.

        Raises:
            SetupError: If a ``package.xml`` cannot be read.
        """
        found: dict[str, Path] = {}
        for entry in sorted((self.workspace / 'src').iterdir()):
            if not entry.is_dir():
                continue  # a link to a folder that is not there yet
            manifests = [entry / 'package.xml', *sorted(entry.glob('*/package.xml'))]
            for manifest in manifests:
                if manifest.is_file():
                    found[_package_name(manifest)] = manifest.parent.resolve()
                    if manifest.parent == entry:
                        break  # a package holds no packages
        return {k: v for k, v in sorted(found.items()) if k not in COPIES or not self.ros_has(k)}


def _package_name(manifest: Path) -> str:
    try:
        name = ElementTree.parse(manifest).getroot().findtext('name')  # nosec B314
    except ElementTree.ParseError as err:
        raise SetupError(f'{manifest} is not XML: {err}') from err
    if not name:
        raise SetupError(f'{manifest} names no package')
    return name.strip()
