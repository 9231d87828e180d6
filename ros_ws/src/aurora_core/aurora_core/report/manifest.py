# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is known of a run before its first stage: the document `manifest.json`."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from aurora_core.execution.faults import Fault
from aurora_core.ports.model_name import OFFLINE
from aurora_core.report.process import ProcessIdentity

MANIFEST_VERSION = 1


class _Lenient(BaseModel):
    # Read by every later version: a field that is not known here is no damage.
    model_config = ConfigDict(frozen=True, extra='ignore')


class ManifestRequest(_Lenient):
    """The part of the request that a report repeats.

    Attributes:
        prompt: As typed.
    """

    prompt: str | None = None
    engine: str = 'local'
    model: str = OFFLINE
    map_name: str = 'downtown'
    seed: int = 1
    faults: tuple[Fault, ...] = ()


class Manifest(_Lenient):
    """The manifest as it is read again.

    Attributes:
        run_id: '' in manifests of older versions.
        started_utc: ISO 8601.
        process: Who writes the run.
    """

    schema_version: int = MANIFEST_VERSION
    run_id: str = ''
    started_utc: str = ''
    process: ProcessIdentity
    versions: dict[str, str] = Field(default_factory=dict)
    request: ManifestRequest = ManifestRequest()


def manifest_facts(
    started: datetime, process: ProcessIdentity, versions: Mapping[str, str]
) -> dict[str, Any]:
    """Return what a manifest says beside the request.

    Args:
        started: Aware time of the start.
        process: Who writes the run.
        versions: Versions of the product and of what decides results.
    """
    return {
        'schema_version': MANIFEST_VERSION,
        'started_utc': started.astimezone(UTC).isoformat(timespec='seconds'),
        'process': process.model_dump(mode='json'),
        'versions': dict(sorted(versions.items())),
    }
