# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Sourced by up: starting nodes, and starting again between runs what has died.
#
# A node counts as dead when its process has ended, when it stays stopped (SIGSTOP) or when the
# orchestrator says that a run found it silent. It is never restarted during a run: the orchestrator
# holds a shared lock on `busy` as long, and a restart takes place under the exclusive one. The
# kernel frees the lock of an orchestrator that was killed.

TRIES=3            # restarts of one node ...
TRIES_WITHIN_S=60  # ... within this time; then it is FAILED
RESTART_LIMIT_S=60 # until a restarted node must serve
STOPPED_LOOKS=4    # a node that is stopped so many looks in a row counts as dead
LOOK_S=0.25

declare -A tries=() stopped=() given_up=() not_before_s=()

# Seconds since boot, steady, in `now_s`.
clock() { read -r now_s _ < /proc/uptime; now_s="${now_s%.*}"; }

# Waits without a process of its own: nothing ever comes through this pipe.
exec {silence}<> <(:)
nap() { read -r -t "$1" -u "$silence" || true; }

# Starts one node in a process group of its own, out of reach of a Ctrl-C: start PACKAGE NAME
start() {
  prepare "$2"
  # Job control makes the group, and signals are not ignored (without it a script's background job
  # ignores SIGINT).
  set -m
  (
    trap - INT TERM HUP USR1 PIPE
    # Before it becomes the node: whoever ends us in between finds it all the same.
    write_pid "$2" "$BASHPID"
    take_seat "$2"
    # Where SROS2 is on, each node has keys of its own.
    [ "${ROS_SECURITY_ENABLE:-}" != true ] || export ROS_SECURITY_ENCLAVE_OVERRIDE="/aurora/$2"
    AURORA_READY_FILE="$run_dir/$2.ready" AURORA_SUPERVISION_DIR="$run_dir" \
      exec ros2 run "$1" "$2" < /dev/null > "$log_dir/$2.log" 2>&1 8>&- 9>&- {silence}>&-
  ) &
  # Its end is noticed by looking; the shell need not tell of it.
  disown $!
  # The file must be there before anybody looks for it.
  until [ -e "$run_dir/$2.pid" ] || ! look $!; do nap 0.005; done
  set +m
}

# Starts every node, as forks of one process that has imported what they need; one by one where that
# cannot be (see its log).
start_all() {
  local entry name seat wanted=''
  for name in "${AURORA_NAMES[@]}"; do
    prepare "$name"
    find_seat "$name"
    wanted+="$name ${seat:--}"$'\n'
  done
  (
    trap - INT TERM HUP USR1 PIPE
    exec ros2 run aurora_nodes together "$run_dir" "$log_dir" \
      <<< "${wanted%$'\n'}" > "$log_dir/together.log" 2>&1 8>&- 9>&- {silence}>&-
  ) && return
  heed
  for entry in "${AURORA_NODES[@]}"; do
    if [ -n "$(pid_of "${entry#* }")" ]; then continue; fi
    start "${entry% *}" "${entry#* }"
    heed
  done
}

# Makes room for a node that begins: its files, and the log of the one before.
prepare() {
  local log="$log_dir/$1.log"
  rm -f "$run_dir/$1.ready" "$run_dir/$1.silent"
  [ ! -e "$log" ] || mv -f "$log" "$log.1"
}

package_of() {
  local entry
  for entry in "${AURORA_NODES[@]}"; do [ "${entry#* }" != "$1" ] || echo "${entry% *}"; done
}

# Kills what there is of a node at once.
end_now() {
  local pid state started group
  read -r group _ 2>/dev/null < "$run_dir/$1.pid" || group=''
  if is_alive "$1"; then
    kill -s KILL -- "-$pid" 2>/dev/null || true
    while is_alive "$1"; do nap 0.01; done
  elif [ -n "$group" ] && ! look "$group"; then
    # Its leader is gone; a node below a real `ros2 run` may be left.
    kill -s KILL -- "-$group" 2>/dev/null || true
  fi
  forget "$1"
}

# Whether a node is well; else `reason` says what is wrong.
is_well() {
  local pid state started children='' child
  reason=''
  if ! is_alive "$1"; then reason='ended'; return 1; fi
  if [ "$state" != T ]; then
    # A real `ros2 run` is the parent of the node.
    { read -r children < "/proc/$pid/task/$pid/children"; } 2>/dev/null
    for child in $children; do
      if look "$child" && [ "$state" = T ]; then break; fi
    done
  fi
  if [ "$state" = T ]; then
    stopped[$1]=$((${stopped[$1]:-0} + 1))
    if [ "${stopped[$1]}" -ge "$STOPPED_LOOKS" ]; then reason='was stopped'; return 1; fi
  else
    stopped[$1]=0
  fi
  if [ -e "$run_dir/$1.silent" ]; then reason='fell silent'; return 1; fi
}

# Whether a dead node may be tried again now; says FAILED when it was tried too often.
may_try() {
  local now_s at recent=''
  clock
  for at in ${tries[$1]:-}; do
    [ $((now_s - at)) -ge "$TRIES_WITHIN_S" ] || recent+=" $at"
  done
  # shellcheck disable=SC2086
  set -- "$1" $recent
  if [ $(($# - 1)) -ge "$TRIES" ]; then
    end_now "$1"
    given_up[$1]=1
    touch "$run_dir/$1.failed"
    echo "$program: $1 FAILED: it $reason again after $TRIES restarts within $TRIES_WITHIN_S s;" \
      "the others stay up; its log: $log_dir/$1.log" >&2
    return 1
  fi
  [ "$now_s" -ge "${not_before_s[$1]:-0}" ] || return 1
  tries[$1]="$recent $now_s"
  # 1, 2, 4 s after this try.
  not_before_s[$1]=$((now_s + (1 << ($# - 1))))
}

# Starts dead nodes again: revive NAME=REASON …
revive() {
  local item name now_s limit_s pid state started
  for item in "$@"; do
    name="${item%%=*}"
    # What its end has left is of use to whoever looks for the cause.
    end_now "$name"
    start "$(package_of "$name")" "$name"
    stopped[$name]=0
  done
  clock
  limit_s=$((now_s + RESTART_LIMIT_S))
  for item in "$@"; do
    name="${item%%=*}"
    until [ -e "$run_dir/$name.ready" ]; do
      heed
      clock
      if ! is_alive "$name" || [ "$now_s" -ge "$limit_s" ]; then break; fi
      nap 0.02
    done
    if [ -e "$run_dir/$name.ready" ] && is_alive "$name"; then
      echo "$program: $name ${item#*=}; started again (process $pid)" >&2
    else
      echo "$program: $name ${item#*=}; it did not start again; its log: $log_dir/$name.log" >&2
      end_now "$name"
    fi
  done
}

# Looks after the nodes until a signal comes.
supervise() {
  local name reason dead
  exec 8>> "$run_dir/busy"
  while :; do
    nap "$LOOK_S"
    heed
    dead=()
    for name in "${AURORA_NAMES[@]}"; do
      if [ -n "${given_up[$name]:-}" ] || is_well "$name"; then continue; fi
      # A run cannot go on without its orchestrator, which holds the lock: end it first.
      if [ "$name" = orchestrator ] && [ "$reason" = 'was stopped' ]; then end_now "$name"; fi
      dead+=("$name=$reason")
    done
    [ ${#dead[@]} -eq 0 ] || attempt "${dead[@]}"
  done
}

# Restarts those of the dead whose turn it is, unless a run is going on.
attempt() {
  local item reason now=()
  flock -n -x 8 || return 0
  for item in "$@"; do
    reason="${item#*=}"
    if may_try "${item%%=*}"; then now+=("$item"); fi
  done
  [ ${#now[@]} -eq 0 ] || revive "${now[@]}"
  flock -u 8
}
