#!/usr/bin/env bash
# The flow in half the chamber, k-epsilon: 500 iterations, half a minute.
. "$(dirname "$0")/../solve.sh"
solve case U k epsilon
