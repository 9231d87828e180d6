# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# The one list of commands. What they do is in tools/.

# For `make demo`. Overridden by the environment; passed on in the environment only, never expanded
# into a shell line, so that quotes and dollar signs arrive as they are.
PROMPT ?= A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego when the van comes within 20 meters.
export PROMPT

.DEFAULT_GOAL := help
.PHONY: help setup demo up down test coverage lint typecheck site lock sbom maps clean

help: ## this list
	@sed -nE 's/^([a-z%-]+):.*## (.*)/make \1\t\2/p' Makefile | expand -t 18

setup: ## virtual environment, ROS 2 and the workspace (seconds when nothing changed)
	@tools/setup.sh

demo: ## one prompt through the ROS graph, with its verdict (PROMPT=… in the environment)
	@tools/demo.sh

up: setup ## start every node and stay in the foreground (Ctrl-C stops them)
	@tools/in_env.sh ros2 run aurora_bringup up

down: ## stop every node
	@tools/in_env.sh ros2 run aurora_bringup down

test: ## every test (PYTEST_ADDOPTS=… for options)
	@tools/setup.sh --dev
	@tools/test.sh

coverage: ## how much of the core the tests run, and which error codes they provoke, in coverage/
	@tools/setup.sh --dev
	@tools/coverage.sh coverage

lint: ## ruff (lint and format), the import rules, bandit, packages, widths and word lists
	@tools/setup.sh --dev --no-build
	@tools/lint.sh

typecheck: ## mypy --strict over sources and tests
	@tools/setup.sh --dev --no-build
	@_ROS_WHEELS_BOOTSTRAP_COMPLETE=1 .venv/bin/python tools/typecheck.py

site: ## the documentation as a site in site/ (no network)
	@tools/setup.sh --dev --no-build
	@NO_MKDOCS_2_WARNING=1 .venv/bin/python -m mkdocs build --strict
	@echo "site: open site/index.html"

bench-%: ## one benchmark or campaign: lockstep, latency, faults, deaths, bags, graphs, endurance, replay, stl, stn, maps, matrix, encounters, online, mutation, trust, contradictions, judged, fidelity, realise, outcome, feasibility, repair, fuzz, guided, retrieval (results in docs/bench)
	@tools/setup.sh --dev
	@tools/in_env.sh python -m aurora_bench.$* --results docs/bench

lock: ## resolve requirements/*.in anew, with hashes (needs Python 3.11 and 3.12)
	@tools/lock.sh

sbom: ## the packages of the run lock as CycloneDX, in sbom.cdx.json
	@tools/setup.sh --no-build
	@.venv/bin/python tools/supply_chain.py sbom sbom.cdx.json

maps: ## build the shipped maps from their sources, and measure them
	@tools/setup.sh --dev
	@tools/maps.sh

clean: ## remove what set-up and builds made
	@tools/clean.sh
