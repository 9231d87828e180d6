#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes SROS2 enclaves for every node of the graph and for its clients, with a full ROS 2 Jazzy:
#   tools/sros2.sh KEYSTORE
# Untried: the wheels that AURORA is developed with have neither `ros2 security` nor the security
# plugins of the middleware. Permissions hold for the present ROS_DOMAIN_ID.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tools/sros2.sh KEYSTORE" >&2; exit 2; }
keystore="$(realpath -m "$1")"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source ros_ws/setup.bash
ros2 security -h > /dev/null 2>&1 || {
  echo "sros2: error: there is no 'ros2 security' here: it needs a full ROS 2 (AURORA_ROS=system)" \
    "with ros-jazzy-sros2" >&2
  exit 1
}
policy="$(mktemp)"
trap 'rm -f "$policy"' EXIT
python3 -m aurora_ros.enclaves > "$policy"
(umask 077 && ros2 security generate_artifacts -k "$keystore" -p "$policy")
cat <<END
Keys and permissions are in $keystore, for ROS_DOMAIN_ID=$ROS_DOMAIN_ID. In the shell of \`up\` and of each client:
  export ROS_SECURITY_KEYSTORE='$keystore' ROS_SECURITY_ENABLE=true ROS_SECURITY_STRATEGY=Enforce
  export ROS_SECURITY_ENCLAVE_OVERRIDE=/aurora/client
\`up\` gives each node its own enclave.
END
