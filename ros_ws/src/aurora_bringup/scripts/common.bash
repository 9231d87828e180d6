# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Sourced by up and down: which nodes there are, where their files lie, who is alive.
#
# The run folder holds of each node
#   NAME.pid     process id, its start time and the boot, so that a recycled id is never taken for it
#   NAME.ready   while it serves
#   NAME.silent  put there by the orchestrator: a run found it silent although its process lives
#   NAME.failed  put there by `up`: it will not be started again
# and mavlink.key (the key of this graph, see make_key), up.pid, lock (held by the `up` that supervises), busy (see supervising.bash), log/.

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
  'aurora_nodes repair'
  'aurora_nodes orchestrator'
)
AURORA_NAMES=("${AURORA_NODES[@]#* }")

run_dir="${AURORA_RUN_DIR:-${HOME:-/tmp}/.ros/aurora}/domain-${ROS_DOMAIN_ID:-0}"
log_dir="${ROS_LOG_DIR:-$run_dir/log}"
key_file="$run_dir/mavlink.key"
boot=''
read -r boot < /proc/sys/kernel/random/boot_id

# Makes the key with which uav_bridge and uav_sim sign MAVLink, new for each graph and for this user
# alone. An AURORA_MAVLINK_KEY_FILE of the user's stays; an empty one turns signing off.
make_key() {
  export AURORA_MAVLINK_KEY_FILE="${AURORA_MAVLINK_KEY_FILE-$key_file}"
  [ "$AURORA_MAVLINK_KEY_FILE" = "$key_file" ] || return 0
  rm -f "$key_file" && (umask 077 && head -c 32 /dev/urandom > "$key_file")
}

fail() { echo "$program: error: $*" >&2; exit 1; }

# Looks at a process without starting another one: sets `state` and `started` (in ticks since
# boot); false when it has ended.
look() {
  local stat=''
  state='' started=''
  { read -r -d '' stat < "/proc/$1/stat"; } 2>/dev/null
  # The name (field 2) may hold blanks; after its bracket come state (field 3) and the rest.
  # shellcheck disable=SC2086
  set -- ${stat##*) }
  [ $# -ge 20 ] || return 1
  state="$1" started="${20}"
  [ "$state" != Z ] && [ "$state" != X ]
}

# Whether the process of a pid file is alive: sets `pid` and `state`.
is_alive() {
  local since='' then=''
  pid=''
  { read -r pid since then < "$run_dir/$1.pid"; } 2>/dev/null
  [ -n "$pid" ] && [ "$then" = "$boot" ] && look "$pid" && [ "$started" = "$since" ]
}

# Process id of a name that is alive; empty otherwise.
pid_of() {
  local pid state started
  if is_alive "$1"; then echo "$pid"; fi
}

# Notes a process: write_pid NAME PID
write_pid() {
  local state started
  look "$2" || return
  echo "$2 $started $boot" > "$run_dir/$1.pid.new"
  mv -f "$run_dir/$1.pid.new" "$run_dir/$1.pid"
}

# Says how commands reach the graph of a process that is in another network than this one.
how_to_reach() {
  [ -n "$1" ] && [ "$(readlink "/proc/$1/ns/net")" != "$(readlink /proc/self/ns/net)" ] || return 0
  echo "; it is isolated: 'ros2 run aurora_bringup inside COMMAND' reaches it"
}

# Removes what a node that has ended leaves behind.
forget() { rm -f "$run_dir/$1".{pid,ready,silent,failed,pid.new}; }
