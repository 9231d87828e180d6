# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""No credential reaches a record, whatever it is called and however a server writes it."""

from __future__ import annotations

import base64
from pathlib import Path
from urllib.parse import quote

import pytest

from aurora_core.errors import ConfigError
from aurora_llm.secrets import redacted
from aurora_llm.settings import load_model_settings

CANARY = 'c4n"ary/+0123456789'


@pytest.mark.parametrize(
    'name',
    [
        'OPENAI_API_KEY',
        'AZURE_AD_TOKEN_ID',
        'GATEWAY_PASSWORD',
        'GOOGLE_APPLICATION_CREDENTIALS',
        'my_secret',
    ],
)
@pytest.mark.parametrize('write', [str, quote, lambda s: quote(s, safe=''), lambda s: f'"{s}"'])
def test_a_variable_with_a_telling_name_is_blanked(name: str, write: object) -> None:
    assert callable(write)
    told = redacted(f'401: {write(CANARY)} is wrong', (), {name: CANARY})
    assert '0123456789' not in told
    assert told.startswith('401: ')


def test_what_a_server_repeats_of_a_header_is_blanked() -> None:
    environment = {'OPENAI_EXTRA_HEADERS': '{"X-Gateway": "Bearer abcdefgh12345"}'}
    told = redacted('unknown token abcdefgh12345', (), environment)
    assert told == 'unknown token [key]'


@pytest.mark.parametrize('where', ['address', 'variable'])
def test_a_login_in_an_address_is_blanked_in_all_its_forms(where: str) -> None:
    address = 'http://somebody:pass%40word@host:1/v1?key=query-value#fragment'
    addresses = (address,) if where == 'address' else ()
    environment = {'HTTPS_PROXY': address} if where == 'variable' else {}
    basic = base64.b64encode(b'somebody:pass@word').decode()
    text = f'{address} Basic {basic} somebody pass@word pass%40word query-value fragment'
    told = redacted(text, addresses, environment)
    for secret in ('somebody', 'pass@word', 'pass%40word', 'query-value', basic):
        assert secret not in told


def test_what_is_no_secret_stays() -> None:
    environment = {'PWD': '/home/somebody', 'KEYBOARD': 'qwertyuiop', 'HOME_KEY': 'short'}
    text = '/home/somebody qwertyuiop short http://host:1/v1'
    assert redacted(text, ('http://host:1/v1',), environment) == text


@pytest.mark.parametrize(
    'text',
    [
        'models: {mine: {model: openai/x, api_key: sk-canary-1}}',
        'models: {mine: {model: 3, api_base: "http://u:sk-canary-1@h"}}',
        'models: {mine: {model: "openai/x", headers: [sk-canary-1',
    ],
)
def test_settings_that_cannot_be_read_are_not_quoted(tmp_path: Path, text: str) -> None:
    file = tmp_path / 'models.yaml'
    file.write_text(text, encoding='utf-8')
    with pytest.raises(ConfigError) as caught:
        load_model_settings(file)
    error: BaseException | None = caught.value
    while error is not None:
        assert 'canary' not in str(error)
        error = error.__cause__ or error.__context__
    assert 'models.yaml' in str(caught.value)
