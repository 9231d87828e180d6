# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The functions of `import aurora`, and the session that keeps a process warm for them."""

from __future__ import annotations

import gc
from importlib import import_module
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import InstanceOf

from aurora.arguments import Faults, PathName, checked
from aurora_cli.answers import Run, check_facts, run_request
from aurora_cli.collector import relax_collector
from aurora_cli.files import full_path
from aurora_cli.installed import installed
from aurora_cli.local_engine import ENGINE
from aurora_core.errors import ConfigError, error_class
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.parsing.text import check_prompt_text
from aurora_core.pipeline.stages import RunControl, RunRequest, request_of
from aurora_core.pipeline.verification import load_bag
from aurora_core.pipeline.verify_run import verify_found
from aurora_core.report.check_report import CheckReport, build_check
from aurora_core.report.find_bag import find_bag
from aurora_core.report.run_report import RunReport
from aurora_core.report.signed_run import Verifier
from aurora_core.report.status import Status
from aurora_core.report.verify_report import VerifyReport
from aurora_llm.parse import check_model_name, read_prompt
from aurora_uav_sim.parameters import installed_model

_RUNS = Path('runs')
# What the first run of a process would have to load.
_NEEDED = (*ENGINE, 'aurora_core.trace.bag_reader')
_MAP = 'downtown'
_SMALL = 'A drone hovers over the ego car for 5 seconds.'


class Session:
    """Prompts one after the other in one process.

    The methods are the functions of the module; as a context, a session has loaded what every run
    needs when it begins, so that the first run is as quick as the later ones, and it lets Python
    look for reference cycles more rarely until it ends. SUMO allows one run at a time in a
    process: run in several processes to use several cores.

    Args:
        out: Folder of the run folders; None: `runs` in the current folder.
    """

    @checked
    def __init__(self, *, out: PathName | None = None) -> None:
        self._out = _RUNS if out is None else Path(out)
        self._collector = gc.get_threshold()

    def __enter__(self) -> Self:
        self._collector = gc.get_threshold()
        relax_collector()
        for name in _NEEDED:
            import_module(name)
        self.check(_SMALL)
        installed().parts(_MAP)
        installed_model()
        return self

    def __exit__(self, *_: object) -> None:
        gc.set_threshold(*self._collector)

    @checked
    def parse(
        self, prompt: str, *, map: str = _MAP, seed: int = 1, model: str = 'offline'
    ) -> ParseOutcome:
        """Read a prompt.

        Args:
            prompt: What is to be simulated, in English.
            map: Name of a map of the configuration.
            seed: Of everything that is drawn, from 0 on.
            model: `offline`, or language models as `aurora run --model` names them.

        Returns:
            A specification with its graph, a question or refusals; always the clauses.

        Raises:
            AuroraError: Prompt, map, seed or model cannot be used, or something broke.
        """
        return read_prompt(installed(), _request(prompt, map_name=map, seed=seed, model=model))

    @checked
    def check(
        self, prompt: str, *, map: str = _MAP, seed: int = 1, model: str = 'offline'
    ) -> CheckReport:
        """Parse, ground and judge feasibility; nothing is simulated. Arguments: see `parse`.

        Returns:
            What `aurora check --json` prints.

        Raises:
            AuroraError: As for `parse`.
        """
        facts = check_facts(_request(prompt, map_name=map, seed=seed, model=model))
        if facts.error is not None:
            raise facts.error
        return build_check(facts)

    @checked
    def run(
        self,
        prompt: str,
        *,
        out: PathName | None = None,
        map: str = _MAP,
        seed: int = 1,
        model: str = 'offline',
        engine: Literal['local', 'ros'] = 'local',
        faults: Faults = (),
        repair: int | None = None,
        control: InstanceOf[RunControl] | None = None,
    ) -> Run:
        """Take a prompt through the whole chain. Other arguments: see `parse`.

        The run folder is the one that `aurora run` leaves, but for the page, which
        `Run.write_page` adds.

        Args:
            prompt: What is to be simulated, in English.
            out: Folder of the run folders; None: that of the session.
            map: Name of a map of the configuration.
            seed: Of everything that is drawn, from 0 on.
            model: Who reads the prompt.
            engine: `local` (this process) or `ros` (the graph that runs, else one that is started
                for the run; its nodes write to standard error).
            faults: Injected run-time faults.
            repair: Runs that repair may spend after a violation; None: as the configuration says.
            control: Progress out, cancel in.

        Raises:
            AuroraError: As for `parse`; or the run ended as `error`: a note names its folder.
            KeyboardInterrupt: Ctrl-C; the run has been closed as cancelled.
        """
        request = _request(
            prompt,
            map_name=map,
            seed=seed,
            model=model,
            engine=engine,
            faults=tuple(faults),
            repair=repair,
        )
        control = RunControl() if control is None else control
        done = run_request(request, full_path(self._out if out is None else Path(out)), control)
        if done.status is Status.CANCELLED and not control.cancelled():
            raise KeyboardInterrupt
        _raise_broken(done.report, done.folder)
        return done

    @checked
    def verify(
        self,
        path: PathName,
        *,
        iteration: int | None = None,
        as_recorded: bool = False,
        trusted: PathName | None = None,
    ) -> VerifyReport:
        """Recompute every margin from a bag alone, and hold it against its run folder.

        Args:
            path: Run folder, bag folder or MCAP file.
            iteration: Repair iteration of a run folder, from 0; None: the reported one.
            as_recorded: Judge by the version, limits, tolerances and map that it was recorded
                with, though others are installed here.
            trusted: File of public keys by one of which the run has to be signed.

        Returns:
            What `aurora verify --json` prints.

        Raises:
            AuroraError: There is no such bag, or it holds nothing that could be judged.
        """
        found = find_bag(str(path), iteration)
        verifier = None if trusted is None else _verifier(Path(trusted))
        content, agsg = load_bag(found.bag)
        return verify_found(
            installed(), found, content, agsg, as_recorded=as_recorded, trusted=verifier
        )


def _request(prompt: str, **options: Any) -> RunRequest:
    """Return the request of a prompt and its options.

    Raises:
        AuroraError: One of them cannot be used.
    """
    request = request_of({'prompt': check_prompt_text(prompt), **options})
    check_model_name(request.model)
    installed().map(request.map_name)
    return request


def _verifier(trusted: Path) -> Verifier:
    """Return what knows the keys of a file.

    Raises:
        AuroraError: It holds none.
    """
    from aurora_cli.output import UsageProblem
    from aurora_cli.signing import load_trusted

    try:
        return load_trusted(trusted)
    except UsageProblem as err:
        raise ConfigError(str(err)) from err


def _raise_broken(report: RunReport, folder: Path) -> None:
    error = report.error
    if error is None:
        return
    kind = error_class(error.code)
    broken = kind(error.message, hint=error.hint, component=error.component, code=error.code)
    broken.add_note(f'run folder: {folder}')
    raise broken


_SESSION = Session()
parse, check, run, verify = _SESSION.parse, _SESSION.check, _SESSION.run, _SESSION.verify
