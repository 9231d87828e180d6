# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a campaign runs: a YAML file, read once and closed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import yaml
from pydantic import Field, FiniteFloat, ValidationError, model_validator

from aurora_bench.prompts.shipped import FIRST, prompt_file
from aurora_bench.results import ResultsError
from aurora_bench.resumable.files import PromptFile, read_files
from aurora_bench.rulers.trial import Trial, trials_of
from aurora_core.document import Document
from aurora_core.errors import AuroraError
from aurora_core.files import DOCUMENT_BYTES, read_bytes
from aurora_core.knowledge.map_folders import list_maps
from aurora_core.outcomes.feasibility import CheckStage
from aurora_core.ports.model_name import OFFLINE
from aurora_core.spec.seed import Seed
from aurora_llm.parse import check_model_name

_SHIPPED = 'shipped:'


class PlanError(AuroraError):
    """A campaign's file is not one."""

    default_component = 'bench'


class Configuration(StrEnum):
    """The paper's configurations, each with all of the one before.

    B1 to B3 let a model write a program, which runs contained. B4 to AURORA compile a typed graph
    and let the managed executor run it; two of these differ by what one of them leaves out and by
    nothing else. Whatever they run is judged afterwards, by the same verifier: in B4 and B5 as
    measurement.
    """

    B1 = 'B1'  # a program, of the names of what it may call
    B2 = 'B2'  # and their documentation
    B3 = 'B3'  # and what was measured of map and bodies, as the parser is shown it
    B4 = 'B4'  # typed AGSG and managed executor
    B5 = 'B5'  # and static verification: requests are refused before they run
    AURORA = 'AURORA'  # and the verdict counts: a violated run is repaired

    @property
    def writes_program(self) -> bool:
        """Whether a model writes a program in place of a typed graph."""
        return self in (Configuration.B1, Configuration.B2, Configuration.B3)

    @property
    def without(self) -> frozenset[CheckStage]:
        """Levels of the check that are left out."""
        return frozenset(CheckStage) if self is Configuration.B4 else frozenset()

    def repair(self, budget: int) -> int:
        """Return how many co-simulations repair may spend.

        Args:
            budget: What the campaign gives where repair is on.
        """
        return budget if self is Configuration.AURORA else 0


TYPED = tuple(c for c in Configuration if not c.writes_program)


class Reader(Document):
    """Who reads the prompts.

    Attributes:
        name: In tables.
        model: As in `aurora run --model`.
        transcripts: Folder of recorded replies in place of the model, from the plan's folder on.
    """

    name: str
    model: str = 'offline'
    transcripts: Path | None = None


class Plan(Document):
    """A campaign.

    Attributes:
        name: Of its files.
        prompts: Prompt files, from the plan's folder on; `shipped:tune` and `shipped:held_out`
            are the first ones that are shipped, `shipped:tune/bench` is one of them.
        end_to_end: Only prompts that are marked so.
        first: Of each file the first prompts, None: all.
        configurations: In the order of the tables. The offline reader writes no programs: with it
            there are no runs of B1 to B3.
        readers: In the order of the tables.
        seeds: Each prompt with each of them; more may be asked for later.
        map: Of all runs.
        repair: Co-simulations that repair may spend where it is on.
        limit_s: Wall seconds of one run.
    """

    name: Annotated[str, Field(pattern=r'^[a-z0-9_]+$')]
    prompts: tuple[str, ...] = Field(min_length=1)
    end_to_end: bool = False
    first: Annotated[int, Field(ge=1)] | None = None
    configurations: tuple[Configuration, ...] = TYPED
    readers: tuple[Reader, ...] = (Reader(name='offline'),)
    seeds: tuple[Seed, ...] = (1,)
    map: str = 'downtown'
    repair: Annotated[int, Field(ge=1)] = 5
    limit_s: Annotated[FiniteFloat, Field(gt=0.0)] = 900.0

    @model_validator(mode='after')
    def _checked(self) -> Plan:
        lists: tuple[tuple[str, Sequence[object]], ...] = (
            ('configurations', self.configurations),
            ('readers', [r.name for r in self.readers]),
            ('seeds', self.seeds),
            ('prompts', self.prompts),
        )
        for name, values in lists:
            if not values or len(set(values)) < len(values):
                raise ValueError(f'{name}: at least one, and each once')
        if self.map not in list_maps():
            raise ValueError(f'map: there is no map {self.map!r}')
        offline = all(r.model == OFFLINE for r in self.readers)
        if offline and all(c.writes_program for c in self.configurations):
            raise ValueError('configurations: the offline reader writes no programs')
        return self


class Task(Document):
    """One run of a campaign.

    Attributes:
        key: Unique in it, the same when it is repeated.
        trial: Prompt and seed.
    """

    key: str
    configuration: Configuration
    reader: Reader
    trial: Trial


def read_plan(path: Path) -> Plan:
    """Return the plan of a file; paths in it are made whole.

    Raises:
        PlanError: It cannot be read or says something that no plan can say.
    """
    try:
        values = yaml.safe_load(read_bytes(path, DOCUMENT_BYTES))
        plan = Plan.model_validate(values)
        for reader in plan.readers:
            check_model_name(reader.model)
    except (yaml.YAMLError, UnicodeDecodeError) as err:
        raise PlanError(f'{path} is no YAML: {err}') from err
    except ValidationError as err:
        told = '; '.join(f'{".".join(map(str, e["loc"]))}: {e["msg"]}' for e in err.errors())
        raise PlanError(f'{path} is no campaign: {told}', hint='see docs/bench/README.md') from err
    folder = path.resolve().parent
    changes: dict[str, Any] = {
        'prompts': tuple(
            p if p.startswith(_SHIPPED) else str(folder / p) for p in plan.prompts
        ),
        'readers': tuple(
            r if r.transcripts is None else r.model_copy(
                update={'transcripts': folder / r.transcripts}
            )
            for r in plan.readers
        ),
    }  # fmt: skip
    return plan.model_copy(update=changes)


def files_of(plan: Plan) -> tuple[PromptFile, ...]:
    """Return the prompt files of a plan.

    Raises:
        ResultsError: One cannot be read, or is no prompt file.
    """
    return read_files([path for name in plan.prompts for path in _paths(name)])


def tasks_of(plan: Plan, files: Sequence[PromptFile]) -> tuple[Task, ...]:
    """Return every run: seed by seed, so that a whole table of the first one is there soonest.

    Within a seed prompt by prompt: what is compared runs side by side.
    """
    return tuple(
        Task(
            key=f'{trial.key}:{reader.name}:{configuration.value}',
            configuration=configuration,
            reader=reader,
            trial=trial,
        )
        for trial in _trials(plan, files)
        for reader in plan.readers
        for configuration in plan.configurations
        if reader.model != OFFLINE or not configuration.writes_program
    )


def _trials(plan: Plan, files: Sequence[PromptFile]) -> Iterator[Trial]:
    for seed in plan.seeds:
        for file in files:
            pairs = [
                (p, d)
                for p, d in zip(file.prompts, file.documents, strict=True)
                if p.end_to_end or not plan.end_to_end
            ]
            yield from trials_of(file, pairs[: plan.first], (seed,), file.sha256[:8])


def _paths(name: str) -> Iterator[Path]:
    if not name.startswith(_SHIPPED):
        yield Path(name)
        return
    split, _, part = name.removeprefix(_SHIPPED).partition('/')
    if split not in ('tune', 'held_out'):
        raise ResultsError(f'{name}: expected shipped:tune or shipped:held_out, with /FILE or not')
    for one in (part,) if part else FIRST:
        yield prompt_file('tune' if split == 'tune' else 'held_out', one)
