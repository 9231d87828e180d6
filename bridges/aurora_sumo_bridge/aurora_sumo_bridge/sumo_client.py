# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The ground simulator: libsumo behind `aurora_core.ports.simulators.GroundSimulator`.

Tick 0 is the spawned state; SUMO's own clock is one step ahead of it (the insertion step), so
tick k is SUMO's time (k + 1) * dt. Weather has no meaning here: what it does to drivers comes in
as commands.
"""

from __future__ import annotations

import libsumo

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import FloatArray, GroundLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_sumo_bridge.checks import check_command
from aurora_sumo_bridge.commands import apply_command
from aurora_sumo_bridge.network import Network
from aurora_sumo_bridge.placement import Body, check_places, place_all
from aurora_sumo_bridge.proxies import UavProxies
from aurora_sumo_bridge.state_reader import StateReader
from aurora_sumo_bridge.street_watch import StreetWatch
from aurora_sumo_bridge.sumo_process import SumoProcess


class _Run:
    """What lives from load to close."""

    def __init__(self, load: GroundLoad, process: SumoProcess) -> None:
        self.process = process
        self.agent_ids = tuple(agent.agent_id for agent in load.agents)
        self.network = Network()
        self.bodies, places = place_all(load.agents, self.network, load.dt_s)
        self.walkers: tuple[tuple[int, Body], ...] = tuple(
            (index, body) for index, body in enumerate(self.bodies) if body.walker is not None
        )
        self.parked: tuple[tuple[int, Body], ...] = tuple(
            (index, body) for index, body in enumerate(self.bodies) if body.parked is not None
        )
        self.watch = StreetWatch(
            (
                (row, body.agent_id, body.driver, body.length_m, body.width_m)
                for row, body in enumerate(self.bodies)
                if body.driver is not None
            ),
            (b.walker.free for b in self.bodies if b.walker is not None and b.walker.free),
        )
        self.proxies = UavProxies()
        self.reader = StateReader(self.bodies, load.dt_s)
        self.tick = 0
        self.state = self.reader.read_spawned()
        check_places(self.bodies, places, self.reader.boxes())


class SumoClient:
    """SUMO in this process, in lockstep; implements `GroundSimulator`.

    One client per process can be loaded. After any error the client can be loaded again.
    """

    def __init__(self) -> None:
        self._run: _Run | None = None

    @property
    def tick(self) -> int:
        """Tick of the current state; -1 when nothing is loaded."""
        return self._run.tick if self._run is not None else -1

    def load(self, load: GroundLoad) -> None:
        """Start from scratch and place every agent exactly; `state` is then tick 0.

        A client that is loaded already is reset (about 20 ms); the same load and the same
        commands give the same bits.

        Raises:
            GroundSimulatorError: Another client of this process is loaded, map or vTypes do not
                load, a number is out of range, or an agent cannot be placed exactly.
        """
        self.close()
        process = SumoProcess(
            net_path=load.net_path,
            vtypes_path=load.vtypes_path,
            dt_s=load.dt_s,
            seed=load.seed,
        )
        try:
            self._run = _Run(load, process)
        except libsumo.TraCIException as err:
            process.close()
            raise GroundSimulatorError(f'SUMO failed while placing the agents: {err}') from err
        except BaseException:
            process.close()
            raise

    def state(self) -> FloatArray:
        """Return a copy of the packed state (N, GROUND_WIDTH) of the current tick.

        Raises:
            GroundSimulatorError: Nothing is loaded.
        """
        return self._loaded().state.copy()

    def advance(self, tick: int, commands: tuple[GroundCommand, ...]) -> FloatArray:
        """Apply the commands stamped `tick`, advance to tick * dt, return the packed state.

        Asking for the current tick again returns its state without stepping (a repeated message
        on the wire). Commands to agents that are gone are ignored. When a number or a text of any
        command is out of range, none of them is applied and the tick may be asked again; one that
        does not fit the agent or its place leaves those before it applied.

        Args:
            tick: The next tick, or the current one.
            commands: In the order in which they are to take effect.

        Returns:
            State (N, GROUND_WIDTH), roster order.

        Raises:
            GroundSimulatorError: A gap in the ticks, a command that cannot be carried out (names
                agent, command, value), a state that is not finite, or SUMO failed. After SUMO
                itself failed the client is closed.
        """
        run = self._loaded()
        if tick == run.tick:
            return run.state.copy()
        if tick != run.tick + 1:
            raise GroundSimulatorError(f'asked for tick {tick} after tick {run.tick}')
        for command in commands:
            check_command(command, run.agent_ids)
        for command in commands:
            if run.reader.is_present(command.agent):
                apply_command(command, run.bodies[command.agent], run.network)
                if command.kind is GroundCommandKind.REMOVE:
                    run.reader.mark_gone(command.agent)
        try:
            _step(run)
            run.state = run.reader.read()
        except libsumo.TraCIException as err:
            self.close()
            raise GroundSimulatorError(f'SUMO failed in tick {tick}: {err}') from err
        except GroundSimulatorError:
            self.close()
            raise
        run.tick = tick
        return run.state.copy()

    def show_uavs(self, rows: FloatArray) -> None:
        """Let each UAV stand in the ground world, where SUMO shows it and traffic ignores it.

        Args:
            rows: Packed states (M, UAV_WIDTH), roster order.

        Raises:
            GroundSimulatorError: Nothing is loaded.
        """
        self._loaded().proxies.show(rows)

    def collisions(self) -> tuple[tuple[str, str], ...]:
        """Return the pairs (collider, victim) that SUMO lists in this tick.

        For diagnostics: SUMO also counts gaps below the minimum gap; the verdict recomputes.
        """
        self._loaded()
        return tuple((c.collider, c.victim) for c in libsumo.simulation.getCollisions())

    def teleports(self) -> tuple[str, ...]:
        """Return the vehicles that SUMO began to teleport in this tick (expected: none)."""
        self._loaded()
        return tuple(libsumo.simulation.getStartingTeleportIDList())

    def close(self) -> None:
        """Free the simulation; safe to call twice."""
        if self._run is not None:
            run, self._run = self._run, None
            run.process.close()

    def _loaded(self) -> _Run:
        if self._run is None:
            raise GroundSimulatorError('no scenario is loaded in the ground simulator')
        return self._run


def _step(run: _Run) -> None:
    for index, body in run.parked:
        if body.parked is not None and run.reader.is_present(index):
            body.parked.hold()
    for index, body in run.walkers:
        if body.walker is not None and run.reader.is_present(index):
            body.walker.step_freely()
    run.watch.step(run.reader.is_present)
    libsumo.simulationStep()
    for index, body in run.walkers:
        if body.walker is not None and run.reader.is_present(index):
            body.walker.hold_on_arrival()
