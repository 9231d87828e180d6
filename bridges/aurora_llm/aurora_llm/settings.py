# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`config/models.yaml`, and which models a `--model` means."""

from __future__ import annotations

from pathlib import Path

import yaml
from pydantic import Field, NonNegativeFloat, PositiveFloat, PositiveInt, ValidationError

from aurora_core.document import Document
from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_text
from aurora_core.knowledge.config_files import config_path
from aurora_core.ports.model_name import OFFLINE, RECORDED, check_no_secret, without_secrets
from aurora_core.retrieval.background import Amounts

_MOST_ATTEMPTS = 10


class ModelEntry(Document):
    """One model of the list.

    Attributes:
        model: litellm's name, `provider/model`.
        api_base: Address of the server, None for the provider's own.
        schema_output: Ask for output that is held to the schema (`schema:` in the file).
        short: Ask in the short form, for models that lose themselves in a long one.
    """

    model: str = Field(min_length=1)
    api_base: str | None = None
    schema_output: bool = Field(default=True, alias='schema')
    short: bool = False


class RetrievalSettings(Amounts):
    """What is selected for a prompt.

    Attributes:
        embedding: Rank by word vectors beside words, where they are installed.
    """

    embedding: bool


class ModelSettings(Document):
    """See `config/models.yaml`."""

    retrieval: RetrievalSettings
    fallback: tuple[str, ...]
    attempts: PositiveInt = Field(le=_MOST_ATTEMPTS)
    timeout_s: PositiveFloat
    most_wait_s: NonNegativeFloat
    max_tokens: PositiveInt
    temperature: NonNegativeFloat
    models: dict[str, ModelEntry]

    def order(self, named: str) -> tuple[str, ...]:
        """Return the names to ask, in order.

        Args:
            named: The `--model` as given; commas give the whole order, else `fallback` follows.

        Raises:
            ConfigError: There is no name in it, `offline` is not the last, or an address in it
                holds a secret.
        """
        try:
            check_no_secret(named)
        except ValueError as err:
            raise ConfigError(str(err), hint='see docs/models.md') from err
        # A path may hold a comma: what is recorded stands alone.
        parts = (named,) if named.startswith(RECORDED) else tuple(named.split(','))
        given = tuple(part.strip() for part in parts if part.strip())
        more = self.fallback if len(given) == 1 and given[0] != OFFLINE else ()
        order = tuple(dict.fromkeys((*given, *more)))
        if not order or OFFLINE in order[:-1]:
            raise ConfigError(
                f'expected model names with {OFFLINE} only as the last, found {named!r}',
                hint='for example --model openai/gpt-4o,offline; see docs/models.md',
            )
        return order

    def entry(self, name: str) -> ModelEntry:
        """Return the model of a name: of the list, or litellm's own with or without an address.

        Raises:
            ConfigError: It is neither.
        """
        if name in self.models:
            return self.models[name]
        model, _, address = name.partition('@')
        if not all(model.partition('/')):
            raise ConfigError(
                f'expected {OFFLINE}, {RECORDED}FILE, provider/model or one of '
                f'{", ".join(sorted(self.models)) or "no names"}, found {without_secrets(name)!r}',
                hint='see config/models.yaml and docs/models.md',
            )
        if not address.startswith(('http://', 'https://')):
            return ModelEntry(model=name)
        return ModelEntry(model=model, api_base=address)


def load_model_settings(path: Path | None = None) -> ModelSettings:
    """Return the settings.

    Raises:
        ConfigError: The file is missing, is no YAML, or does not have this form.
    """
    file = path if path is not None else config_path('models.yaml')
    try:
        return ModelSettings.model_validate(yaml.safe_load(read_text(file, CONFIG_BYTES)))
    except (OSError, UnicodeDecodeError) as err:
        problem = str(err)
    except yaml.YAMLError as err:
        problem = _of_yaml(err)
    except ValidationError as err:
        problem = _of_form(err)
    # Raised outside: no trace back to an error that quotes the file, which may hold secrets.
    raise ConfigError(f'{file} cannot be used: {problem}', hint='see docs/models.md')


def _of_yaml(err: yaml.YAMLError) -> str:
    """Say where it is no YAML, without the line itself."""
    mark = getattr(err, 'problem_mark', None)
    where = f' in line {mark.line + 1}, column {mark.column + 1}' if mark is not None else ''
    return f'it is no YAML{where}'


def _of_form(err: ValidationError) -> str:
    """Say which values do not fit and why, without the values."""
    found = err.errors(include_url=False, include_context=False, include_input=False)
    return '; '.join(f'{".".join(map(str, e["loc"])) or "all of it"}: {e["msg"]}' for e in found)
