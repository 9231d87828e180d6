# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bench record FILE --model MODEL --transcripts DIR`: ask once, repeat offline."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.campaign.plan import Configuration
from aurora_bench.campaign.written import write_program
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.progress import Progress
from aurora_bench.prompts.reading import read_prompts
from aurora_bench.results import ResultsError
from aurora_bench.seeds import seed_option
from aurora_cli.installed import installed
from aurora_core.errors import ConfigError
from aurora_core.pipeline.stages import RunRequest
from aurora_core.ports.language_model import LanguageModel
from aurora_core.ports.model_name import OFFLINE
from aurora_llm.parse import check_model_name, read_prompt
from aurora_llm.reply_store import RecordingClient, ReplyStore

USAGE = 64
BROKEN = 4


def main(arguments: Sequence[str] | None = None) -> int:
    """Record; return 0, 64 when nothing can be asked, 4 when the store cannot be written."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora bench record', description=__doc__)
    parser.add_argument('file', type=Path, metavar='FILE', help='prompts, one JSON object a line')
    parser.add_argument('--model', required=True, help='who is asked, as in aurora run')
    parser.add_argument(
        '--transcripts', type=Path, required=True, metavar='DIR', help='where replies are kept'
    )
    parser.add_argument('--map', default='downtown', help='map that the prompts are read against')
    parser.add_argument('--seed', type=seed_option, default=1)
    parser.add_argument('--only', default='', help='prompts whose id begins so')
    parser.add_argument(
        '--programs', action='store_true', help='the programs of B1 to B3 of a campaign as well'
    )
    parser.add_argument('--history', type=Path, default=None, help='past runs; nothing is added')
    options = parser.parse_args(arguments)
    try:
        check_model_name(options.model)
        if options.model == OFFLINE:
            raise ConfigError('the offline parser has no replies to record')
        prompts = [p for p in read_prompts(options.file) if p.id.startswith(options.only)]
    except (ResultsError, ConfigError) as err:
        sys.stderr.write(f'{err}\n')
        return USAGE
    store = ReplyStore(options.transcripts)
    progress = Progress('record', len(prompts))
    asked = understood = 0
    for prompt in prompts:
        clients: list[RecordingClient] = []

        def wrap(model: LanguageModel, clients: list[RecordingClient] = clients) -> LanguageModel:
            clients.append(RecordingClient(model, store))
            return clients[-1]

        request = RunRequest(
            prompt=prompt.prompt,
            map_name=options.map,
            seed=options.seed,
            model=options.model,
            history=options.history,
            history_frozen=True,
        )
        try:
            outcome = read_prompt(installed(), request, wrap=wrap)
            for configuration in Configuration if options.programs else ():
                if configuration.writes_program:
                    write_program(configuration, installed(), request, wrap)
        except ConfigError as err:
            sys.stderr.write(f'{prompt.id}: {err}\n')
            return BROKEN
        calls = sum(client.asked for client in clients)
        asked += calls
        understood += outcome.spec is not None
        told = f'{calls} calls' if calls else 'recorded already'
        progress.step(f'{prompt.id}: {told}{"" if outcome.spec else ", no specification"}')
    sys.stdout.write(
        f'recorded {len(prompts)} prompts, {asked} calls, {understood} specifications\n'
    )
    return 0


if __name__ == '__main__':
    sys.exit(main())
