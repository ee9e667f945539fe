#!/bin/sh
# in_private_network.sh PROGRAM: runs it in a network of its own, first without and then with a
# multicast route. Exit status 77 where the machine gives nobody a network of his own.
unshare -rn true 2>/dev/null || exit 77
unshare -rn sh -c 'ip link set lo up && "$0"' "$1" || exit 1
CAIRN_TEST_ROUTE=1 unshare -rn sh -c '
  ip link set lo up && ip route add 239.255.76.67/32 dev lo src 127.0.0.1 && "$0"' "$1"
