#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Resolves requirements/*.in into locks with hashes, one per Python. Versions in the present locks
# are kept where they fit; LOCK_UPGRADE=1 takes the newest. Interpreters: PYTHON311, PYTHON312.
# Only the default package index counts: what a machine's pip configuration adds stays out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../requirements"
unset PYTHONPATH PIP_FIND_LINKS PIP_INDEX_URL PIP_EXTRA_INDEX_URL
export PIP_CONFIG_FILE=/dev/null PIP_DISABLE_PIP_VERSION_CHECK=1

scratch="$(mktemp -d)"
trap 'rm -rf -- "$scratch"' EXIT

options=(--quiet --generate-hashes --allow-unsafe --strip-extras --no-annotate --no-header
  --no-emit-index-url --no-emit-find-links --no-emit-trusted-host)
[ "${LOCK_UPGRADE:-}" = 1 ] && options+=(--upgrade)

# compile TAG SOURCE KIND [OPTION…]: SOURCE.in into KIND-pyTAG.txt
compile() {
  local tag="$1" source="$2" output="$3-py$1.txt"
  shift 3
  echo "lock: $output"
  "$scratch/$tag/bin/pip-compile" "${options[@]}" "$@" -o "$scratch/$output" "$source.in" 2>"$scratch/log" || {
    tail -n 20 "$scratch/log" >&2
    echo "lock: error: $source.in has no solution for Python $tag (above)" >&2
    exit 1
  }
  if grep -niE 'pyarrow==|litellm==1\.82\.[78]|://|@ *file:' "$scratch/$output" >&2; then
    echo "lock: error: $output has a package or an address that must not be in it (above)" >&2
    exit 1
  fi
  { echo "# Made by \`make lock\` from $source.in; do not edit."; cat "$scratch/$output"; } > "$output.new"
  mv "$output.new" "$output"
}

for tag in 3.11 3.12; do
  variable="PYTHON${tag/./}"
  python="${!variable:-python$tag}"
  if ! "$python" -c "import sys; sys.exit('%d.%d' % sys.version_info[:2] != '$tag')" 2>/dev/null; then
    echo "lock: error: no Python $tag as '$python'; name one with $variable=…" >&2
    exit 1
  fi
  "$python" -m venv "$scratch/$tag"
  "$scratch/$tag/bin/python" -m pip install --quiet --upgrade pip 'pip-tools==7.6.2'
  # What is locked already, for 3.12 what 3.11 got, is preferred: same versions on both.
  for kind in run dev rivals fuzz system system-dev; do
    preferred="${kind#system-}-py3.11.txt"
    [ "$kind" != system ] || preferred=run-py3.11.txt
    if [ -f "$preferred" ]; then cp "$preferred" "$scratch/$kind-py$tag.txt"; fi
  done
  compile "$tag" run run
  compile "$tag" dev dev -c "run-py$tag.txt"
  compile "$tag" rivals rivals
  compile "$tag" fuzz fuzz
  # The system's ROS 2 Jazzy has Python 3.12 only.
  if [ "$tag" = 3.12 ]; then
    compile "$tag" system system
    compile "$tag" dev system-dev -c "system-py$tag.txt"
  fi
done
