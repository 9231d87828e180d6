# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Sourced by up and down: stopping nodes in the right order.

# The executor first (it ends a run that is going on), then who obeys it, then the clock, then the
# recorder, which has to see all of that, then the rest at once.
AURORA_STOP_GROUPS=(
  'executor'
  'sumo_bridge uav_bridge'
  'sync'
  'recorder'
  'monitor grounding parser repair orchestrator uav_sim'
)

# Each signal and how long it may take, in tenths of a second.
AURORA_SIGNALS=('INT 30' 'TERM 20' 'KILL 10')

# Stops the named nodes together; says what it took.
stop_group() {
  local name pid step signal patience living=() left=()
  for name in "$@"; do
    if [ -n "$(pid_of "$name")" ]; then living+=("$name"); else forget "$name"; fi
  done
  for step in "${AURORA_SIGNALS[@]}"; do
    read -r signal patience <<< "$step"
    for name in "${living[@]}"; do
      pid="$(pid_of "$name")"
      [ -n "$pid" ] || continue
      # To the group: a real `ros2 run` is the parent of the node. A stopped one must go on to end.
      kill -s "$signal" -- "-$pid" 2>/dev/null || true
      kill -s CONT -- "-$pid" 2>/dev/null || true
    done
    while [ ${#living[@]} -gt 0 ]; do
      left=()
      for name in "${living[@]}"; do
        if [ -n "$(pid_of "$name")" ]; then left+=("$name"); continue; fi
        forget "$name"
        case "$signal" in
          INT) echo "$name stopped" ;;
          *) echo "$name stopped (only SIG$signal did it)" ;;
        esac
      done
      living=("${left[@]}")
      [ "$patience" -gt 0 ] || break
      patience=$((patience - 1))
      [ ${#living[@]} -eq 0 ] || sleep 0.1
    done
  done
  for name in "${living[@]}"; do echo "$name cannot be stopped (process $(pid_of "$name"))" >&2; done
  [ ${#living[@]} -eq 0 ]
}

stop_all() {
  local group names code=0
  for group in "${AURORA_STOP_GROUPS[@]}"; do
    read -ra names <<< "$group"
    stop_group "${names[@]}" || code=1
  done
  return "$code"
}
