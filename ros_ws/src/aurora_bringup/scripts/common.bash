# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Sourced by up and down: which nodes there are, where their files lie, who is alive.
#
# Of each node the run folder holds NAME.pid (process id and its start time, so that a recycled id
# is never taken for the node), NAME.ready while it serves, and its log.

# Package and executable, in the order of starting: what others wait for comes first.
AURORA_NODES=(
  'aurora_uav_sim uav_sim'
  'aurora_sync sync'
  'aurora_sumo_bridge sumo_bridge'
  'aurora_uav_bridge uav_bridge'
  'aurora_nodes recorder'
  'aurora_nodes monitor'
  'aurora_nodes executor'
  'aurora_nodes grounding'
  'aurora_nodes parser'
  'aurora_nodes orchestrator'
)

run_dir="${AURORA_RUN_DIR:-${HOME:-/tmp}/.ros/aurora}/domain-${ROS_DOMAIN_ID:-0}"
log_dir="${ROS_LOG_DIR:-$run_dir/log}"

fail() { echo "$program: error: $*" >&2; exit 1; }

# The kernel's start time of a process, in ticks since boot; empty if it is gone or a zombie.
start_time() {
  local stat
  stat="$(cat "/proc/$1/stat" 2>/dev/null)" || return 0
  # The name (field 2) may hold blanks; after its bracket come state (field 3) and the rest.
  read -ra stat <<< "${stat##*) }"
  [ "${stat[0]}" = Z ] || echo "${stat[19]}"
}

# Process id of a name that is alive, from its pid file; empty otherwise.
pid_of() {
  local pid='' started=''
  [ -r "$run_dir/$1.pid" ] && read -r pid started < "$run_dir/$1.pid"
  if [ -n "$pid" ] && [ -n "$started" ] && [ "$(start_time "$pid")" = "$started" ]; then echo "$pid"; fi
}

# Notes a process: write_pid NAME PID
write_pid() {
  echo "$2 $(start_time "$2")" > "$run_dir/$1.pid.new"
  mv -f "$run_dir/$1.pid.new" "$run_dir/$1.pid"
}
