# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Sourced by up: the processor core that each node of the tick path keeps to.
#
# A tick is passed from node to node hundreds of times a second. A node that wakes on another core
# than before finds nothing of its own in that core's cache, which made a tick half as long again.
# Nodes that work in turn share a core. Only the vehicles fly while the traffic drives, so they have
# the second one. The observers have the third where there is one. Graphs of several domains begin
# at different cores. AURORA_SEATS=0 leaves everything to the kernel.

declare -A SEATS=(
  [sync]=0 [executor]=0 [sumo_bridge]=0
  [uav_bridge]=1 [uav_sim]=1
  [recorder]=2 [monitor]=2
)

# Cores that this process may use, one word each, in `cores`.
read_cores() {
  local key list part
  cores=()
  while read -r key list; do
    [ "$key" = Cpus_allowed_list: ] || continue
    for part in ${list//,/ }; do
      eval "cores+=({${part%-*}..${part#*-}})"
    done
  done < /proc/self/status
}

# Sets `seat` to the core of a node; empty when it may use any.
find_seat() {
  local cores place="${SEATS[$1]:-}"
  seat=''
  [ -n "$place" ] && [ "${AURORA_SEATS:-1}" != 0 ] || return 0
  read_cores
  local count="${#cores[@]}" most=$((${#cores[@]} < 3 ? ${#cores[@]} : 3))
  [ "$count" -gt 1 ] || return 0
  [ "$place" -lt "$most" ] || place=$((most - 1))
  local apart=$((count > most ? most : 1))
  seat="${cores[(${ROS_DOMAIN_ID:-0} * apart + place) % count]}"
}

# Puts this process, and what it becomes, on the core of a node.
take_seat() {
  local seat
  find_seat "$1"
  [ -z "$seat" ] || taskset --cpu-list --pid "$seat" "$BASHPID" > /dev/null
}
