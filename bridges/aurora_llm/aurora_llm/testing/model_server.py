# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A local server that speaks OpenAI's chat completions and does as it is told, also badly."""

from __future__ import annotations

import gzip
import json
import threading
from collections.abc import Sequence
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import TracebackType
from typing import Any, Self

_DRIP_PERIOD_S = 0.05
_FLOOD = b' ' * (1 << 16)


@dataclass(frozen=True, slots=True, kw_only=True)
class Turn:
    """How one request is answered.

    Attributes:
        text: What the model says.
        status: HTTP status; an error has `text` as its message.
        headers: Further HTTP headers.
        raw: Body in place of a completion.
        hang: Says nothing until the server is closed.
        drip: Sends a blank now and then, for ever.
        flood: Sends so many bytes before the body.
        packed: Sends the body compressed, whatever was asked for.
        cut: Announces the whole body, sends half of it, closes the connection.
        finish: `length` when the model ran into its limit.
    """

    text: str = ''
    status: int = 200
    headers: dict[str, str] = field(default_factory=dict)
    raw: str | None = None
    hang: bool = False
    drip: bool = False
    cut: bool = False
    flood: int = 0
    packed: bool = False
    finish: str = 'stop'


class ModelServer:
    """Serves turns in order on a free port of this machine; the last one again and again.

    Args:
        turns: What to do, request by request.
    """

    def __init__(self, turns: Sequence[Turn]) -> None:
        self.requests: list[dict[str, Any]] = []
        """Bodies of the requests so far."""
        self.authorizations: list[str] = []
        self.sent_bytes = 0
        """Of floods."""
        self._turns = list(turns)
        self._closing = threading.Event()
        outer = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = 'HTTP/1.1'

            def do_POST(self) -> None:
                outer._answer(self)

            def log_message(self, *_: object) -> None:
                """Keep the output of tests clean."""

        self._server = ThreadingHTTPServer(('127.0.0.1', 0), Handler)
        self._server.daemon_threads = True
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)

    @property
    def url(self) -> str:
        """The `api_base`."""
        return f'http://127.0.0.1:{self._server.server_address[1]}/v1'

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        err: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._closing.set()
        self._server.shutdown()
        self._server.server_close()

    def _answer(self, handler: BaseHTTPRequestHandler) -> None:
        length = int(handler.headers.get('Content-Length', 0))
        self.requests.append(json.loads(handler.rfile.read(length)))
        self.authorizations.append(handler.headers.get('Authorization', ''))
        turn = self._turns[min(len(self.requests), len(self._turns)) - 1]
        if turn.hang:
            self._closing.wait()
            handler.close_connection = True
            return
        body = (turn.raw if turn.raw is not None else _body(turn)).encode()
        body = gzip.compress(body) if turn.packed else body
        handler.send_response(turn.status)
        handler.send_header('Content-Type', 'application/json')
        handler.send_header('Content-Length', str(turn.flood + len(body)))
        if turn.packed:
            handler.send_header('Content-Encoding', 'gzip')
        for name, value in turn.headers.items():
            handler.send_header(name, value)
        handler.end_headers()
        try:
            for _ in range(0, turn.flood, len(_FLOOD)):
                handler.wfile.write(_FLOOD)
                self.sent_bytes += len(_FLOOD)
            while turn.drip and not self._closing.wait(_DRIP_PERIOD_S):
                handler.wfile.write(b' ')
            handler.wfile.write(body[: len(body) // 2] if turn.cut or turn.drip else body)
        except OSError:
            pass  # the client has gone, as it should
        handler.close_connection = turn.cut or turn.drip


def _body(turn: Turn) -> str:
    if turn.status != 200:
        return json.dumps({'error': {'message': turn.text, 'type': 'error', 'code': turn.status}})
    return json.dumps(
        {
            'id': 'chatcmpl-1',
            'object': 'chat.completion',
            'created': 0,
            'model': 'local',
            'choices': [
                {
                    'index': 0,
                    'message': {'role': 'assistant', 'content': turn.text},
                    'finish_reason': turn.finish,
                }
            ],
            'usage': {'prompt_tokens': 100, 'completion_tokens': 10, 'total_tokens': 110},
        }
    )
