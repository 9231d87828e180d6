# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora sign`: put every file of a run under the signature of a key of the user."""

from __future__ import annotations

from pathlib import Path

from aurora_cli.output import UsageProblem, print_json, say
from aurora_cli.signing import load_signer, make_key
from aurora_core.report.run_folder import SIGNED
from aurora_core.report.signed_run import sign_run


def sign_command(run: str, key: Path, root: Path, *, new_key: bool, as_json: bool) -> int:
    """Sign a run and return the exit code.

    Args:
        run: Run folder or run id.
        key: File of the private key.
        root: Folder of the run folders.
        new_key: Make the key first.
        as_json: Answer with a JSON document.

    Raises:
        UsageProblem: There is no such run, or no such key, or the key lies in the run.
        AuroraError: The run is not finished, or cannot be written.
    """
    folder = next((p for p in (Path(run), root / run) if p.is_dir()), None)
    if folder is None:
        raise UsageProblem(f'{run} is neither a run folder nor a run in {root}')
    folder = folder.resolve()
    if key.resolve().is_relative_to(folder):
        raise UsageProblem(f'{key} lies in the run: whoever gets the run would get the key')
    if new_key:
        make_key(key)
        say(f'aurora: made the key {key}; give {key}.pub to who shall trust it')
    signer, name = load_signer(key)
    signed = sign_run(folder, signer)
    if as_json:
        print_json({'run': str(folder), 'key': name, 'signed': signed.model_dump(mode='json')})
        return 0
    say(f'aurora: signed {len(signed.files)} files of {signed.run_id} ({signed.status})')
    say(f'aurora: by {name}, in {folder / SIGNED}; aurora verify RUN --trusted FILE.pub checks it')
    return 0
