# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Knowledge`: what every stage reads beside the request, as one value that is passed on."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from aurora_core.errors import AuroraError
from aurora_core.execution.map_parts import MapParts, map_parts
from aurora_core.execution.plan import EXECUTOR_VERSION
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.ground import Grounder
from aurora_core.knowledge.agent_types import AgentTypeRecord, load_agent_types
from aurora_core.knowledge.basis import Basis, Tables
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import Limits, Tolerances, load_limits, load_tolerances
from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.knowledge.map_records import MeasuredMap, load_measured_map
from aurora_core.knowledge.settings import Settings, load_settings
from aurora_core.knowledge.uav_record import (
    UavRecord,
    load_uav_record,
    possible_limits,
    possible_settings,
)
from aurora_core.knowledge.world import WorldModel
from aurora_core.repair.settings import RepairSettings, load_repair_settings
from aurora_core.report.versions import AURORA_VERSION


class Knowledge:
    """What the stages are given to work with: limits, tolerances, settings, types, and maps.

    Whoever runs stages makes one and passes it to each of them. Maps, and what all runs on a map
    share, are loaded when they are first asked for.

    Args:
        limits: Limits as configured; those in force ask nothing that `uav` cannot do.
        tolerances: Tolerances in force.
        settings: Settings of grounding and execution, as configured.
        types: Ground agents by type, as measured.
        uav: The multirotor as measured; it is never planned to do more.
    """

    def __init__(
        self,
        *,
        limits: Limits,
        tolerances: Tolerances,
        settings: Settings,
        types: Mapping[str, AgentTypeRecord],
        uav: UavRecord,
    ) -> None:
        self.limits = possible_limits(limits, uav)
        self.tolerances = tolerances
        self.settings = possible_settings(settings, limits, uav)
        self.types = types
        self.uav = uav
        tables = Tables(limits=self.limits, tolerances=self.tolerances, settings=self.settings)
        self.basis = Basis.of(AURORA_VERSION, tables)
        self._maps: dict[str, MapModel] = {}
        self._measured: dict[str, MeasuredMap | None] = {}
        self._airspaces: dict[str, Airspace] = {}
        self._grounders: dict[str, Grounder] = {}
        self._parts: dict[str, MapParts] = {}

    @cached_property
    def repair(self) -> RepairSettings:
        """How repair searches; read when it is first needed, it decides nothing else."""
        return load_repair_settings()

    def map(self, name: str) -> MapModel:
        """Return a map by name (verified against its digest when first loaded)."""
        if name not in self._maps:
            self._maps[name] = load_map(name)
        return self._maps[name]

    def measured(self, name: str) -> MeasuredMap | None:
        """Return the records of a map, None where it was not measured.

        Raises:
            ConfigError: They are damaged, or were made of something else than is installed.
        """
        if name not in self._measured:
            self._measured[name] = load_measured_map(
                self.map(name), self.settings.run.dt_s, self.settings.grounding.clearance_m
            )
        return self._measured[name]

    def parts(self, name: str) -> MapParts:
        """Return what the runs on a map share."""
        if name not in self._parts:
            self._parts[name] = map_parts(self.map(name), self._airspace(name))
        return self._parts[name]

    def grounder(self, name: str) -> Grounder:
        """Return the grounder of a map."""
        if name not in self._grounders:
            measured = self.measured(name)
            self._grounders[name] = Grounder(
                self.map(name),
                self.types,
                self.limits,
                self.tolerances,
                self.settings,
                self.basis,
                EXECUTOR_VERSION,
                None if measured is None else measured.spawns,
                self._airspace(name),
                None if measured is None else measured.walks,
            )
        return self._grounders[name]

    def _airspace(self, name: str) -> Airspace:
        if name not in self._airspaces:
            known, measured = self.map(name), self.measured(name)
            lattice = None if measured is None else measured.lattice
            self._airspaces[name] = Airspace(known.buildings, known.zones, lattice)
        return self._airspaces[name]

    def parts_of(self, world: WorldModel) -> MapParts | None:
        """Return the parts of the installed map whose solids a recorded world has, else None."""
        try:
            known = self.map(world.map_name)
        except AuroraError:
            return None
        same = known.buildings == world.buildings and known.zones == world.no_fly_zones
        return self.parts(world.map_name) if same else None


def installed_knowledge() -> Knowledge:
    """Return the knowledge that the configuration folder holds.

    Raises:
        ConfigError: A file is missing or broken, or was measured of something else.
    """
    return Knowledge(
        limits=load_limits(config_path('limits.json')),
        tolerances=load_tolerances(config_path('tolerances.json')),
        settings=load_settings(),
        types=load_agent_types(),
        uav=load_uav_record(),
    )
