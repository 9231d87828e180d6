# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Source this file in bash, from any folder:  source ros_ws/setup.bash
# It puts ros2 (the real one where there is one, else our small stand-in), aurora and the packages
# into the environment, and keeps ROS 2 on this machine: one domain, 127.0.0.1 only. What you set
# before (ROS_DOMAIN_ID, RMW_IMPLEMENTATION, FASTRTPS_DEFAULT_PROFILES_FILE, …) stays.

if [ -z "${BASH_VERSION:-}" ]; then
  echo "aurora: setup.bash needs bash" >&2
  return 1
fi
if [[ "${BASH_SOURCE[0]}" == "$0" ]]; then
  echo "aurora: source this file instead of running it:  source ${BASH_SOURCE[0]}" >&2
  exit 1
fi

# Takes a value out of a list like PATH.
_aurora_remove() {
  local -n _aurora_list="$1"
  local _aurora_rest=":${_aurora_list:-}:"
  while [[ "$_aurora_rest" == *":$2:"* ]]; do _aurora_rest="${_aurora_rest/":$2:"/:}"; done
  _aurora_rest="${_aurora_rest#:}"
  _aurora_list="${_aurora_rest%:}"
}

# Puts a value in front of such a list, once.
_aurora_prepend() {
  _aurora_remove "$1" "$2"
  local -n _aurora_list="$1"
  _aurora_list="$2${_aurora_list:+:$_aurora_list}"
  export "${1?}"
}

# The ROS 2 install's own script reads variables that may not exist.
_aurora_source_system() {
  local _aurora_nounset=0 _aurora_code=0
  [[ $- == *u* ]] && _aurora_nounset=1
  set +u
  # shellcheck disable=SC1091
  source /opt/ros/jazzy/setup.bash || _aurora_code=$?
  (( _aurora_nounset )) && set -u
  return "$_aurora_code"
}

_aurora_setup() {
  local here venv install site profile folder
  here="${BASH_SOURCE[0]}"
  [[ "$here" == */* ]] || here="./$here"
  here="$(cd -- "${here%/*}/" && pwd -P)" || return 1
  venv="${here%/*}/.venv"
  install="$here/install"
  # Written by `make setup` as its last step.
  local AURORA_BUILT_FOR='' AURORA_BUILT_ROS='' AURORA_BUILT_PYTHON='' AURORA_BUILT_PATHS=()
  # shellcheck disable=SC1091
  [[ -r "$install/aurora_env.bash" ]] && source "$install/aurora_env.bash"
  if [[ "$AURORA_BUILT_FOR" != "$here" || ! -x "$venv/bin/python" ]]; then
    echo "aurora: ${here%/*} is not set up yet: call 'make setup' there first" >&2
    return 1
  fi

  if [[ "$AURORA_BUILT_ROS" == system ]]; then
    _aurora_source_system || return 1
  else
    site="$venv/lib/python$AURORA_BUILT_PYTHON/site-packages"
    for folder in "$site"/ros_*.libs; do _aurora_prepend LD_LIBRARY_PATH "$folder"; done
    _aurora_prepend LD_LIBRARY_PATH "$venv/lib"
    _aurora_prepend AMENT_PREFIX_PATH "$venv"
    _aurora_prepend CMAKE_PREFIX_PATH "$venv"
    # The wheels start every Python twice to set LD_LIBRARY_PATH, which has just been done.
    export _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
    export ROS_DISTRO=jazzy ROS_VERSION=2 ROS_PYTHON_VERSION=3
  fi
  _aurora_prepend LD_LIBRARY_PATH "$install/lib"
  _aurora_prepend AMENT_PREFIX_PATH "$install"
  _aurora_prepend CMAKE_PREFIX_PATH "$install"
  for folder in "${AURORA_BUILT_PATHS[@]}"; do _aurora_prepend PYTHONPATH "$here/$folder"; done
  _aurora_prepend PATH "$install/lib/aurora_cli"
  _aurora_prepend PATH "$venv/bin"
  export COLCON_DEFAULTS_FILE="$here/colcon_defaults.yaml"

  # Our ros2 goes last and only where no other is found.
  _aurora_remove PATH "$install/lib/aurora_ros2cli"
  type -P ros2 >/dev/null || PATH="$PATH:$install/lib/aurora_ros2cli"

  # Isolation: a domain of our own, and nothing listens on another address than 127.0.0.1. With our
  # profile the discovery range must be SYSTEM_DEFAULT (the profile says why); with a profile of
  # the user's, LOCALHOST keeps discovery on this machine.
  export ROS_DOMAIN_ID="${ROS_DOMAIN_ID:-87}"
  export RMW_IMPLEMENTATION="${RMW_IMPLEMENTATION:-rmw_fastrtps_cpp}"
  profile="$install/share/aurora_bringup/config/fastdds_localhost.xml"
  case "${FASTRTPS_DEFAULT_PROFILES_FILE:-}" in
    '' | */aurora_bringup/config/fastdds_localhost.xml)
      export FASTRTPS_DEFAULT_PROFILES_FILE="$profile"
      export ROS_AUTOMATIC_DISCOVERY_RANGE="${ROS_AUTOMATIC_DISCOVERY_RANGE:-SYSTEM_DEFAULT}" ;;
    *) export ROS_AUTOMATIC_DISCOVERY_RANGE="${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}" ;;
  esac
  hash -r 2>/dev/null || true
}

_aurora_setup && _aurora_status=0 || _aurora_status=$?
unset -f _aurora_setup _aurora_prepend _aurora_remove _aurora_source_system
# Leaves the status as that of `source`, without a variable behind.
eval "unset _aurora_status; return $_aurora_status"
