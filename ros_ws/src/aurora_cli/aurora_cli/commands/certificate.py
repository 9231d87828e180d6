# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora certificate check`: 0 valid, 1 refuted, 4 unreadable or not checked."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import ValidationError

from aurora_cli.output import answer_console, print_json
from aurora_core.errors import ReportError
from aurora_core.files import DOCUMENT_BYTES, read_bytes, read_json, read_text
from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck import Outcome, recheck
from aurora_core.report.run_folder import PROMPT, is_run_id
from aurora_core.report.terminal import headline, line

_REFUTED = 1
_NOT_CHECKED = 4
_SHOWN = {
    Outcome.VALID: ('valid', 'green'),
    Outcome.REFUTED: ('refuted', 'red'),
    Outcome.NOT_CHECKED: ('not checked', 'yellow'),
}


def certificate_command(file: Path, *, as_json: bool) -> int:
    """Check every certificate in a file and return the exit code.

    Raises:
        ReportError: The file cannot be read, holds no certificate, or is of another run than the
            folder that it lies in.
    """
    path = file / 'report.json' if file.is_dir() else file
    document = _read(path)
    _check_run(path, document)
    proofs = _certificates(document, path)
    spec = _spec_beside(path, document)
    findings = [recheck(proof, spec) for proof in proofs]
    valid = all(finding.valid for finding in findings)
    if as_json:
        print_json(
            {
                'file': str(path),
                'valid': valid,
                'with_specification': spec is not None,
                'certificates': [
                    {
                        'kind': proof.kind,
                        'sentence': proof.sentence,
                        'valid': finding.valid,
                        'outcome': finding.outcome.value,
                        'steps': list(finding.steps),
                    }
                    for proof, finding in zip(proofs, findings, strict=True)
                ],
            }
        )
    else:
        console = answer_console()
        for proof, finding in zip(proofs, findings, strict=True):
            word, colour = _SHOWN[finding.outcome]
            headline(console, word, colour, proof.sentence)
            for step in finding.steps:
                line(console, f'  {step}')
        if spec is None:
            line(console, 'no specification beside it: what the prompt says was not checked')
    if any(finding.outcome is Outcome.REFUTED for finding in findings):
        return _REFUTED
    return 0 if valid else _NOT_CHECKED


def _read(path: Path) -> Any:
    try:
        return read_json(path, DOCUMENT_BYTES)
    except (OSError, ValueError) as err:
        raise ReportError(
            f'{path} cannot be read as JSON: {err}',
            hint='name feasibility.<k>.json or report.json of a run, or a run folder',
        ) from err


def _check_run(path: Path, document: Any) -> None:
    """Refuse the report of a run in the folder of another one: beside it lies another request.

    Raises:
        ReportError: It is one.
    """
    if not isinstance(document, dict) or not {'run_id', 'prompt'} <= document.keys():
        return
    name = path.absolute().parent.name
    prompt = path.with_name(PROMPT)
    of_another = is_run_id(name) and document['run_id'] != name
    if of_another or (
        prompt.is_file() and read_bytes(prompt, DOCUMENT_BYTES) != _bytes(document['prompt'])
    ):
        raise ReportError(
            f'{path} is of run {document["run_id"]}, which is not the one of its folder',
            hint='name the folder of that run',
        )


def _bytes(text: object) -> bytes:
    return str(text).encode('utf-8', 'surrogatepass')


def _certificates(document: Any, path: Path) -> tuple[Certificate, ...]:
    """Return the certificates of a report, a feasibility verdict, a list or one certificate."""
    found = document
    for key in ('feasibility', 'certificates'):
        if isinstance(found, dict) and key in found:
            found = found[key]
    if isinstance(found, dict):
        found = [found]
    try:
        proofs = tuple(Certificate.model_validate(entry) for entry in found or ())
    except (ValidationError, TypeError) as err:
        raise ReportError(f'{path} holds something else than certificates: {err}') from err
    if not proofs:
        raise ReportError(
            f'{path} holds no certificate', hint='only a run that is infeasible has one'
        )
    return proofs


def _spec_beside(path: Path, document: Any) -> dict[str, Any] | None:
    """Return the specification in the document or of the same run, the prompt alone, or None."""
    if isinstance(document, dict) and isinstance(document.get('spec'), dict):
        return dict(document['spec'])
    parts = path.name.split('.')
    number = parts[1] if len(parts) == 3 and parts[1].isdigit() else '0'
    spec = path.with_name(f'spec.{number}.json')
    if spec.exists():
        value = _read(spec)
        return value if isinstance(value, dict) else None
    prompt = path.with_name('prompt.txt')
    if prompt.exists():
        return {'prompt': read_text(prompt, DOCUMENT_BYTES, 'replace')}
    return None
