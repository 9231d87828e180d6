# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The files of a campaign: what was found in one, how long it took in another.

What was found is the same to the last bit whoever ran it and however often it was interrupted.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import FiniteFloat, ValidationError

from aurora_bench.campaign.plan import Plan, PlanError
from aurora_bench.campaign.record import CampaignRun
from aurora_bench.machine import Machine
from aurora_bench.results import ResultsError, write_whole
from aurora_core.document import Document
from aurora_core.files import read_json
from aurora_core.report.run_folder import json_text

RUNS, SECONDS, PARQUET = 'runs.json', 'seconds.json', 'runs.parquet'
_MOST_BYTES = 1 << 30


class Campaign(Document):
    """What a campaign found.

    Attributes:
        plan: What was run; paths left out.
        files: Digest by name of each prompt file.
        code: Digest of the product's code and configuration.
        versions: Of the product and of what decides its results.
        transcripts: Digest of the recorded replies by reader.
        quarantined: Keys of runs that were lost twice, with the reason.
        runs: In the order of the plan, without seconds.
    """

    campaign_version: int = 1
    plan: Mapping[str, Any]
    files: Mapping[str, str]
    code: str
    versions: Mapping[str, str]
    transcripts: Mapping[str, str] = {}
    quarantined: Mapping[str, str] = {}
    runs: tuple[CampaignRun, ...]


class Spent(Document):
    """How long a campaign took; another every time.

    Attributes:
        machine: Where.
        seconds: By stage, of every run by its key.
    """

    machine: Machine
    seconds: Mapping[str, Mapping[str, float]]


def plan_values(plan: Plan) -> dict[str, Any]:
    """Return a plan as plain values without paths of this machine."""
    values = plan.model_dump(mode='json', exclude={'limit_s'})
    values['prompts'] = [
        p if p.startswith('shipped:') else Path(p).name for p in plan.prompts
    ]  # fmt: skip
    values['readers'] = [{'name': r.name, 'model': r.model} for r in plan.readers]
    return values


def write_campaign(
    folder: Path, campaign: Campaign, runs: Sequence[CampaignRun], machine: Machine
) -> str:
    """Write all files of a campaign and return the digest (sha256, hex) of what was found.

    Args:
        folder: Made if it is not there.
        campaign: What was found.
        runs: The same runs, with their seconds.
        machine: Where they were made.

    Raises:
        ResultsError: A file cannot be written.
    """
    data = json_text(campaign).encode()
    write_whole(folder / RUNS, data)
    spent = Spent(machine=machine, seconds={r.key: dict(r.seconds) for r in runs})
    write_whole(folder / SECONDS, json_text(spent).encode())
    write_parquet(folder / PARQUET, campaign.runs)
    return hashlib.sha256(data).hexdigest()


def read_campaign(folder: Path) -> tuple[Campaign, Spent]:
    """Return what `write_campaign` wrote, the runs with their seconds.

    Raises:
        PlanError: There is none, or it is damaged.
    """
    try:
        campaign = Campaign.model_validate(read_json(folder / RUNS, _MOST_BYTES))
        spent = Spent.model_validate(read_json(folder / SECONDS, _MOST_BYTES))
    except (OSError, ValueError, ValidationError) as err:
        raise PlanError(
            f'{folder} holds no finished campaign: {err}', hint='aurora campaign run FILE.yaml'
        ) from err
    timed = tuple(
        r.model_copy(update={'seconds': spent.seconds.get(r.key, {})}) for r in campaign.runs
    )
    return campaign.model_copy(update={'runs': timed}), spent


def write_parquet(path: Path, runs: Sequence[CampaignRun]) -> None:
    """Write runs as a Parquet file, one row each; lists and maps are JSON text.

    Raises:
        ResultsError: It cannot be written.
    """
    import duckdb

    rows = [_flat(run) for run in runs]
    columns = ', '.join(f'"{name}" {kind}' for name, kind in _columns())
    marks = ', '.join('?' for _ in _columns())
    temporary = path.with_name(f'.writing-{os.getpid()}-{path.name}')
    try:
        # One thread: rows keep their order, and equal rows give equal bytes.
        with duckdb.connect(config={'threads': 1}) as base:
            base.execute(f'CREATE TABLE runs ({columns})')
            if rows:
                base.executemany(f'INSERT INTO runs VALUES ({marks})', rows)
            target = str(temporary).replace("'", "''")
            base.execute(f"COPY runs TO '{target}' (FORMAT parquet)")
        temporary.replace(path)
    except (OSError, duckdb.Error) as err:
        raise ResultsError(f'{path} cannot be written: {err}') from err
    finally:
        temporary.unlink(missing_ok=True)


def _columns() -> tuple[tuple[str, str], ...]:
    kinds: Mapping[object, str] = {bool: 'BOOLEAN', int: 'BIGINT', FiniteFloat | None: 'DOUBLE'}
    return tuple(
        (name, kinds.get(info.annotation, 'VARCHAR'))
        for name, info in CampaignRun.model_fields.items()
        if name != 'seconds'
    )


def _flat(run: CampaignRun) -> list[Any]:
    values = run.model_dump(mode='json')
    return [
        json.dumps(values[name], sort_keys=True)
        if isinstance(values[name], list | dict)
        else values[name]
        for name, _ in _columns()
    ]
