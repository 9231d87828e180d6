# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `aurora` command. Options only; what a command does is imported when it is called."""

from __future__ import annotations

import io
import os
import sys
import traceback
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Annotated, Any, NoReturn, cast

import typer

from aurora_cli.collector import relax_collector
from aurora_cli.export_commands import add_export_commands, add_sign_command
from aurora_cli.finish import Json, Quiet, finish
from aurora_cli.help_commands import add_help_commands
from aurora_cli.map_commands import maps
from aurora_cli.output import BROKEN, INTERRUPTED, USAGE, UsageProblem, say
from aurora_core.errors import hint_for

# Typer carries its own copy of click: the class is reached through one that it exports.
_USAGE_ERROR = cast(type[Exception], typer.BadParameter.__mro__[1])

app = typer.Typer(
    name='aurora',
    help='Compile a prompt into a scenario, check it, run it, verify it.',
    no_args_is_help=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={'help_option_names': ['-h', '--help']},
)
certificate = typer.Typer(help='Certificates of infeasibility.', rich_markup_mode=None)
bag = typer.Typer(help='Recordings.', rich_markup_mode=None)
add_help_commands(app)
app.add_typer(maps, name='map')
app.add_typer(certificate, name='certificate')
app.add_typer(bag, name='bag')
add_export_commands(app, bag)
add_sign_command(app)
bench = typer.Typer(help='Measurements over prompt files.', rich_markup_mode=None)
app.add_typer(bench, name='bench')

Prompt = Annotated[
    str | None, typer.Argument(metavar='[PROMPT]', help='The prompt, or - for standard input.')
]
PromptFile = Annotated[
    Path | None, typer.Option('--prompt-file', metavar='FILE', help='Read the prompt from a file.')
]
CheckPicture = Annotated[
    Path | None,
    typer.Option('--picture', metavar='FILE', help='Draw where it would happen (.png or .svg).'),
]
Model = Annotated[
    str,
    typer.Option(
        help='offline (no key, no network), or language models: NAME, provider/NAME[@URL], '
        'recorded:FILE, several with commas in order; see config/models.yaml.'
    ),
]
History = Annotated[
    Path | None,
    typer.Option(
        metavar='DIR',
        help='Past verified runs that a language model may be shown; a verified run is added.',
    ),
]
Frozen = Annotated[
    bool, typer.Option('--freeze-history', help='Add nothing to the history (campaigns).')
]
Transcripts = Annotated[
    Path | None,
    typer.Option(
        metavar='DIR', help='Replies recorded by aurora bench record, in place of the models.'
    ),
]
Seed = Annotated[int, typer.Option(help='Seed of everything that is drawn.')]
Map = Annotated[str, typer.Option('--map', help='Map, see: aurora map list.')]
Repair = Annotated[
    int | None,
    typer.Option(min=0, metavar='N', help='Runs that repair may spend (see config/repair.yaml).'),
]
Jobs = Annotated[
    int | None,
    typer.Option(min=1, metavar='J', help='Processes that execute candidates of repair.'),
]
Dask = Annotated[
    str | None,
    typer.Option(metavar='ADDRESS', help='Scheduler whose workers do so; local: one of its own.'),
]
NoRepair = Annotated[bool, typer.Option('--no-repair', help='End with the first verdict.')]
RunOrBag = Annotated[str, typer.Argument(metavar='RUN_OR_BAG', help='Run folder, run id or bag.')]
Iteration = Annotated[
    int | None, typer.Option(min=0, help='Repair iteration, from 0; default: the one reported.')
]
Plots = Annotated[
    Path | None,
    typer.Option(metavar='DIR', help='Draw each condition over time into this folder (PNG, SVG).'),
]
AsRecorded = Annotated[
    bool,
    typer.Option(
        '--as-recorded',
        help='Judge by the version, limits, tolerances and map that it was recorded with, though '
        'others are installed here.',
    ),
]
Trusted = Annotated[
    Path | None,
    typer.Option(metavar='KEY', help='Claim nothing unless one of these public keys signed it.'),
]
Anything = {'allow_extra_args': True, 'ignore_unknown_options': True}


@app.command('run')
def run_prompt(
    prompt: Prompt = None,
    prompt_file: PromptFile = None,
    engine: Annotated[str, typer.Option(help='local (one process) or ros (the graph).')] = 'local',
    model: Model = 'offline',
    history: History = None,
    freeze_history: Frozen = False,
    transcripts: Transcripts = None,
    seed: Seed = 1,
    map_name: Map = 'downtown',
    out: Annotated[Path, typer.Option(help='Folder of the run folders.')] = Path('runs'),
    allow_relax: Annotated[
        bool,
        typer.Option(
            '--allow-relax', help='Of a violated run, say with which stated numbers it would hold.'
        ),
    ] = False,
    repair: Repair = None,
    no_repair: NoRepair = False,
    jobs: Jobs = None,
    dask: Dask = None,
    fault: Annotated[
        list[str] | None,
        typer.Option(metavar='JSON', help='Inject a run-time fault (for tests; repeatable).'),
    ] = None,
    seeds: Annotated[
        int | None,
        typer.Option(
            metavar='N', help='Run N seeds from --seed on: how often is it verified, by how much?'
        ),
    ] = None,
    autopilot: Annotated[
        str,
        typer.Option(
            metavar='udp://HOST:PORT', help='Fly real time with autopilots of your own, as PX4.'
        ),
    ] = '',
    picture: Annotated[
        bool, typer.Option('--picture', help='Draw picture.png, too; aurora open does so later.')
    ] = False,
    quiet: Quiet = False,
    as_json: Json = False,
) -> None:
    """Run a prompt through the whole chain and say what came of it."""

    def command() -> int:
        from aurora_cli.beside.chosen import Elsewhere
        from aurora_cli.commands.run import run_command
        from aurora_cli.requests import RunOptions

        options = RunOptions(
            engine=engine,
            model=model,
            history=history,
            freeze_history=freeze_history,
            transcripts=transcripts,
            seed=seed,
            map_name=map_name,
            out=out,
            allow_relax=allow_relax,
            repair=0 if no_repair else repair,
            faults=tuple(fault or ()),
            elsewhere=Elsewhere(jobs=jobs, dask=dask),
            autopilot=autopilot,
        )
        if seeds is not None:
            if picture:
                raise UsageProblem('--picture is for one run; aurora open RUN draws any of them')
            from aurora_cli.commands.seeds import seeds_command

            return seeds_command(prompt, prompt_file, options, seeds, quiet=quiet, as_json=as_json)
        return run_command(
            prompt, prompt_file, options, picture=picture, quiet=quiet, as_json=as_json
        )

    finish(command, as_json=as_json)


@app.command('check')
def check_prompt(
    prompt: Prompt = None,
    prompt_file: PromptFile = None,
    model: Model = 'offline',
    history: History = None,
    transcripts: Transcripts = None,
    seed: Seed = 1,
    map_name: Map = 'downtown',
    picture: CheckPicture = None,
    quiet: Quiet = False,
    as_json: Json = False,
) -> None:
    """Parse, ground and judge feasibility; nothing is simulated."""

    def command() -> int:
        from aurora_cli.commands.check import check_command
        from aurora_cli.requests import RunOptions

        options = RunOptions(
            model=model, history=history, transcripts=transcripts, seed=seed, map_name=map_name
        )
        return check_command(prompt, prompt_file, options, picture, quiet=quiet, as_json=as_json)

    finish(command, as_json=as_json)


@app.command('verify')
def verify_bag(
    run_or_bag: RunOrBag,
    iteration: Iteration = None,
    plots: Plots = None,
    as_recorded: AsRecorded = False,
    trusted: Trusted = None,
    as_json: Json = False,
) -> None:
    """Recompute every margin from the bag alone, and hold the bag against its run folder."""

    def command() -> int:
        from aurora_cli.commands.verify import verify_command

        return verify_command(
            run_or_bag, iteration, plots, as_recorded=as_recorded, as_json=as_json, trusted=trusted
        )

    finish(command, as_json=as_json)


@app.command('repair')
def repair_run(
    run_or_bag: RunOrBag,
    repair: Repair = None,
    jobs: Jobs = None,
    dask: Dask = None,
    out: Annotated[Path, typer.Option(help='Folder of the run folders.')] = Path('runs'),
    as_json: Json = False,
) -> None:
    """Realise a recorded, violated request otherwise, in a run of its own."""

    def command() -> int:
        from aurora_cli.beside.chosen import Elsewhere
        from aurora_cli.commands.repair import repair_command

        elsewhere = Elsewhere(jobs=jobs, dask=dask)
        return repair_command(run_or_bag, repair, out, elsewhere, as_json=as_json)

    finish(command, as_json=as_json)


@app.command('diff')
def diff_runs(
    first: RunOrBag, second: RunOrBag, iteration: Iteration = None, as_json: Json = False
) -> None:
    """Show where two recorded runs part: first differing tick, agent, value; margins."""

    def command() -> int:
        from aurora_cli.commands.diff import diff_command

        return diff_command(first, second, iteration, as_json=as_json)

    finish(command, as_json=as_json)


@bag.command('recover')
def recover_recording(
    run_or_bag: RunOrBag,
    out: Annotated[
        Path | None, typer.Option(metavar='FOLDER', help='Default: <bag>.recovered.')
    ] = None,
    iteration: Iteration = None,
    as_json: Json = False,
) -> None:
    """Make a readable bag out of one that was cut short; the original stays as it is."""

    def command() -> int:
        from aurora_cli.commands.recover import recover_command

        return recover_command(run_or_bag, out, iteration, as_json=as_json)

    finish(command, as_json=as_json)


@app.command('picture')
def draw_run(
    run_or_bag: RunOrBag,
    output: Annotated[
        Path | None,
        typer.Option(
            '-o',
            '--output',
            metavar='FILE',
            help='PNG or SVG, for a paper PDF, too; default: in the run folder.',
        ),
    ] = None,
    iteration: Iteration = None,
    style: Annotated[
        str, typer.Option('--style', help='screen, or paper: vector, no title, small.')
    ] = 'screen',
    columns: Annotated[
        int, typer.Option('--columns', min=1, max=2, help='Width of a figure for a paper.')
    ] = 1,
    video: Annotated[
        bool, typer.Option('--video', help='An animated GIF of the map instead.')
    ] = False,
    as_json: Json = False,
) -> None:
    """Draw a recorded run: map, trajectories, events, distances over time."""

    def command() -> int:
        from aurora_cli.commands.picture import PictureOptions, PictureStyle, picture_command

        if style not in set(PictureStyle):
            choices = ', '.join(PictureStyle)
            raise UsageProblem(f'--style takes one of {choices}, found {style}')
        options = PictureOptions(
            output=output,
            iteration=iteration,
            style=PictureStyle(style),
            columns=columns,
            video=video,
        )
        return picture_command(run_or_bag, options, as_json=as_json)

    finish(command, as_json=as_json)


@app.command('graph')
def export_graph(
    run_or_prompt: Annotated[
        str,
        typer.Argument(
            metavar='RUN_OR_PROMPT', help='Run folder, run id, bag, prompt, or - for a prompt.'
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            '-o', '--output', help='PNG, SVG, JSON, GraphML, DOT or Mermaid (.mmd) file.'
        ),
    ] = None,
    why: Annotated[
        str | None,
        typer.Option(metavar='ID', help='What affects this condition, or what a parameter does.'),
    ] = None,
    seed: Seed = 1,
    map_name: Map = 'downtown',
    iteration: Iteration = None,
    as_json: Json = False,
) -> None:
    """Show the scenario graph of a run or a prompt, and what in it affects what."""

    def command() -> int:
        from aurora_cli.commands.graph import GraphOptions, graph_command
        from aurora_cli.requests import RunOptions

        run = RunOptions(seed=seed, map_name=map_name)
        options = GraphOptions(output=output, why=why, iteration=iteration, run=run)
        return graph_command(run_or_prompt, options, as_json=as_json)

    finish(command, as_json=as_json)


@certificate.command('check')
def check_certificate(
    file: Annotated[Path, typer.Argument(help='feasibility.<k>.json, report.json or a proof.')],
    as_json: Json = False,
) -> None:
    """Check certificates of infeasibility again, with separate code."""

    def command() -> int:
        from aurora_cli.commands.certificate import certificate_command

        return certificate_command(file, as_json=as_json)

    finish(command, as_json=as_json)


@app.command('doctor')
def examine(
    fix: Annotated[
        bool, typer.Option('--fix', help='Remove what is provably ours and dead; close dead runs.')
    ] = False,
    runs: Annotated[Path, typer.Option(help='Folder of the run folders.')] = Path('runs'),
    model: Model = 'offline',
    as_json: Json = False,
) -> None:
    """Look for what is wrong with this machine and environment; each finding with its fix."""

    def command() -> int:
        from aurora_cli.commands.doctor import doctor_command
        from aurora_cli.doctor.machine import Machine

        machine = Machine(runs=runs, model=model)
        return doctor_command(machine, repair=fix, json_wanted=as_json)

    finish(command, as_json=as_json)


def _measurement(package: str) -> Callable[[typer.Context], None]:
    def command(context: typer.Context) -> None:
        from aurora_cli.commands.bench import bench_command

        raise typer.Exit(bench_command(package, context.args))

    return command


for _package, _help in (
    ('fidelity', 'How much of what prompts ask for their specifications hold.'),
    (
        'feasibility',
        'Check requests on both sides of every limit; count what is refused, and why.',
    ),
    ('realise', 'Run what annotations say; count what is realised and what is contradicted.'),
    ('outcome', 'Run prompts to their verdicts; count the right ones and the silent failures.'),
    ('repair', 'Plant faults with known causes; count those that repair finds and mends.'),
    ('record', 'Record the replies of language models, to repeat a campaign without them.'),
):
    bench.command(_package, help=_help, context_settings=Anything, add_help_option=False)(
        _measurement(_package)
    )
app.command(
    'campaign',
    help='Run configurations over prompts and seeds, resumed where left; report their tables.',
    context_settings=Anything,
    add_help_option=False,
)(_measurement('campaign'))


def main() -> NoReturn:
    """Run the command line; usage errors leave with 64, Ctrl-C with 130."""
    for stream in (sys.stdout, sys.stderr):
        # The answer is UTF-8 whatever the locale; bytes that are no text must not break a message.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding='utf-8', errors='backslashreplace')
    relax_collector()
    sys.exit(run_command_line(sys.argv[1:]))


def run_command_line(arguments: list[str]) -> int:
    """Run one command line and return its exit code."""
    if not arguments:
        arguments = ['--help']
    try:
        result = _command()(arguments, prog_name='aurora', standalone_mode=False)
    except UsageProblem as err:
        say(f'aurora: {err}')
        return USAGE
    except _USAGE_ERROR as err:
        say(f'aurora: {_usage_text(err)}')
        return USAGE
    except (KeyboardInterrupt, typer.Abort):
        say('aurora: cancelled')
        return INTERRUPTED
    except BrokenPipeError:
        # Whoever read our answer has left; nobody is there to be told.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return BROKEN
    except Exception as err:  # noqa: BLE001  (the last place that can turn a defect into words)
        if os.environ.get('AURORA_TRACEBACK'):
            traceback.print_exc()
        say(f'aurora: {type(err).__name__}: {err}')
        say(f'        {hint_for(err)}; AURORA_TRACEBACK=1 shows where')
        return BROKEN
    return int(result or 0)


@cache
def _command() -> Any:
    """Return what the options of all commands make; a program may run several."""
    return typer.main.get_command(app)


def _usage_text(err: BaseException) -> str:
    text = str(err.format_message()) if hasattr(err, 'format_message') else str(err)
    context = getattr(err, 'ctx', None)
    commands = getattr(getattr(context, 'command', None), 'commands', None)
    if commands and ' command' in text.lower():
        text = f'{text.rstrip(".")}; there are {", ".join(sorted(commands))}'
    path = getattr(context, 'command_path', None) or 'aurora'
    return f'{text} (try {path} --help)'
