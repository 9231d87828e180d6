# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora campaign run FILE.yaml`, `report FOLDER` and `gallery RUN…`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.campaign.plan import PlanError
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.resumable.journal import JournalError
from aurora_core.errors import AuroraError, ConfigError

_USAGE, _BROKEN, _INTERRUPTED = 64, 4, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run or report a campaign.

    Returns:
        0; 1 when runs are quarantined; 64 when a file or option is wrong; 4 when it cannot be
        carried out; 130 after Ctrl-C.
    """
    stop_on_sigterm()
    options = _parser().parse_args(arguments)
    try:
        if options.command == 'run':
            from aurora_bench.campaign.command import run_campaign

            if options.jobs < 1:
                raise ConfigError(f'--jobs needs at least 1 worker, found {options.jobs}')
            return run_campaign(options)
        if options.command == 'gallery':
            from aurora_bench.campaign.gallery import draw_gallery

            written = draw_gallery(options.runs, options.out)
            sys.stdout.write(''.join(f'{path}\n' for path in written))
            return 0
        from aurora_bench.campaign.report import write_report

        written = write_report(options.folder, options.out or options.folder, name=options.name)
    except KeyboardInterrupt:
        sys.stderr.write('cancelled; the same command goes on with what the journal holds\n')
        return _INTERRUPTED
    except (PlanError, JournalError, ConfigError) as err:
        sys.stderr.write(f'{err}\n')
        return _USAGE
    except AuroraError as err:
        sys.stderr.write(f'{err}\n')
        return _BROKEN
    sys.stdout.write(''.join(f'{path}\n' for path in written))
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='aurora campaign', description='Configurations over prompts and seeds.'
    )
    commands = parser.add_subparsers(dest='command', required=True)
    run = commands.add_parser('run', help='run what a file says, or go on with it')
    run.add_argument('file', type=Path, metavar='FILE.yaml')
    run.add_argument('--out', type=Path, required=True, metavar='FOLDER', help='of its files')
    run.add_argument('--jobs', type=int, default=1, metavar='N', help='worker processes here')
    run.add_argument(
        '--dask',
        default=None,
        metavar='ADDRESS',
        help='workers of this Dask scheduler; local: one that is started for this campaign',
    )
    run.add_argument('--so-far', action='store_true', help='run nothing more; write what is there')
    gallery = commands.add_parser(
        'gallery', help='figures of single runs: views from the UAV, maps, the first one whole'
    )
    gallery.add_argument('runs', type=Path, nargs='+', metavar='RUN', help='run folders')
    gallery.add_argument('--out', type=Path, required=True, metavar='FOLDER', help='of figures')
    report = commands.add_parser('report', help='tables and figures of a finished campaign')
    report.add_argument('folder', type=Path, metavar='FOLDER')
    report.add_argument('--out', type=Path, default=None, metavar='FOLDER', help='of the report')
    report.add_argument('--name', default='campaign', help='of its files')
    return parser


if __name__ == '__main__':
    sys.exit(main())
