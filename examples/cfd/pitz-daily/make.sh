#!/usr/bin/env bash
# The flow over the step: some 400 iterations, 11 s.
. "$(dirname "$0")/../solve.sh"
solve case U p k epsilon nut
