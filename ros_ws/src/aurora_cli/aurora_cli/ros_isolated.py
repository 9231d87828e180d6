# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run on a graph in a network of its own: its client lives in a process in that network.

Parent and child talk through a pipe, a JSON document a line. The parent gives request and folder
and then keeps its end open: where it closes, whoever asked is gone, and the run is cancelled.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from aurora_cli.isolation import ISOLATED, refusal
from aurora_core.errors import AuroraError, ExecutionError, error_class
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.ports.model_name import OFFLINE, RECORDED
from aurora_core.report.run_report import RunReport

_SWITCH = 'AURORA_ISOLATION'
# To cancel a run and stop its graph.
_END_S = 90.0
_LOOK_S = 0.1


def not_isolated(request: RunRequest) -> str:
    """Return why the graph of a run cannot have a network of its own, '' when it can."""
    if os.environ.get(_SWITCH) == '0':
        return f'{_SWITCH}=0'
    if os.environ.get(ISOLATED):
        return 'it is in one already'
    if request.model != OFFLINE and not request.model.startswith(RECORDED):
        # The parser node asks the server.
        return f'{request.model} needs the network of this machine'
    return refusal()


def run_isolated(
    request: RunRequest,
    root: Path,
    control: RunControl,
    tell: Callable[[str], None],
    jobs: int | None = None,
) -> tuple[RunReport, Path]:
    """Start a graph in a network of its own, run a request on it, and stop it.

    Args:
        request: Prompt and options.
        root: Folder of the run folders, absolute.
        control: Progress and cancel.
        tell: Takes what the user should know meanwhile.
        jobs: Processes for candidates of repair; None: as the configuration says.

    Raises:
        ExecutionError: The graph cannot be started, or it gave no report.
        KeyboardInterrupt: Cancelled before the run began.
    """
    python = [sys.executable, '-m']
    command = [*python, 'aurora_cli.isolation', 'new', *python, 'aurora_cli.ros_isolated']
    # A session of its own: a Ctrl-C is for us, and we tell it when to stop.
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
    )
    assert process.stdin is not None
    assert process.stdout is not None
    said: dict[str, Any] = {}
    listener = threading.Thread(
        target=_listen, args=(process.stdout, control, tell, said), daemon=True
    )
    listener.start()
    try:
        asked = {'request': request.model_dump(mode='json'), 'root': str(root), 'jobs': jobs}
        process.stdin.write(json.dumps(asked).encode() + b'\n')
        process.stdin.flush()
        told = False
        while listener.is_alive():
            listener.join(_LOOK_S)
            if control.cancelled() and not told:
                told = True
                process.terminate()
    except BrokenPipeError:
        listener.join(_END_S)
    finally:
        # Also when a second Ctrl-C breaks off here: it stops its graph and ends.
        with suppress(BrokenPipeError):
            process.stdin.close()
        try:
            process.wait(_END_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    return _answer(said, process.returncode)


def _answer(said: dict[str, Any], code: int) -> tuple[RunReport, Path]:
    if said.get('interrupted'):
        raise KeyboardInterrupt
    if 'error' in said:
        told = said['error']
        raise error_class(told['code'])(
            told['message'], hint=told['hint'], component=told['component'], code=told['code']
        )
    if 'report' not in said:
        raise ExecutionError(
            f'the client of the isolated graph ended with {code} and gave no report',
            hint=f'its messages are above; {_SWITCH}=0 starts the graph in the common network',
            component='aurora_cli',
        )
    return RunReport.model_validate(said['report']), Path(said['folder'])


def _listen(
    lines: IO[bytes], control: RunControl, tell: Callable[[str], None], said: dict[str, Any]
) -> None:
    for line in lines:
        document = json.loads(line)
        if 'progress' in document:
            control.progress(*document['progress'])
        elif 'tell' in document:
            tell(document['tell'])
        else:
            said.update(document)


def main() -> int:
    """Run what standard input asks for on a graph of this network; answer on standard output."""
    # What a library prints must not be taken for an answer.
    answers = os.fdopen(os.dup(1), 'w', encoding='utf-8')
    os.dup2(2, 1)
    # Without a buffer, whose lock a thread that waits in it would hold at the end.
    questions = os.fdopen(0, 'rb', buffering=0)
    asked = json.loads(questions.readline())
    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: stop.set())

    def wait_for_the_end() -> None:
        questions.read()
        stop.set()

    threading.Thread(target=wait_for_the_end, daemon=True).start()

    one_at_a_time = threading.Lock()

    def answer(document: dict[str, Any]) -> None:
        try:
            with one_at_a_time:
                answers.write(json.dumps(document) + '\n')
                answers.flush()
        except BrokenPipeError:
            stop.set()

    control = RunControl(
        progress=lambda *progress: answer({'progress': progress}), cancelled=stop.is_set
    )
    try:
        # Imported here: it needs ROS 2, and says so where there is none.
        from aurora_cli.ros_client import run_on_own_graph

        request = RunRequest.model_validate(asked['request'])
        root, jobs = Path(asked['root']), asked['jobs']
        report, folder = run_on_own_graph(request, root, control, jobs)
        answer({'report': report.model_dump(mode='json'), 'folder': str(folder)})
    except KeyboardInterrupt:
        answer({'interrupted': True})
    except AuroraError as err:
        told = {'code': err.code, 'component': err.component}
        answer({'error': {**told, 'message': err.message, 'hint': err.hint}})
    return 0


if __name__ == '__main__':
    sys.exit(main())
