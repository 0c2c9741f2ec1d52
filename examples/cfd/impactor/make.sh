#!/usr/bin/env bash
# The laminar flow of the nozzle: 500 iterations, 10 s.
. "$(dirname "$0")/../solve.sh"
solve case U
