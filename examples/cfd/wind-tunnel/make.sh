#!/usr/bin/env bash
# The air in the wind tunnel, as the OpenFOAM plug-in's case computes it (k-omega SST, 230 iterations, 2 s). Its dictionaries are there.
. "$(dirname "$0")/../solve.sh"
tunnel=../../../plugins/openfoam/cases/windTunnel/flow
rm -rf case
mkdir case
cp -r "$tunnel"/{0.orig,system} case
mkdir case/constant
cp "$tunnel"/constant/*Properties case/constant
solve case U k omega
rm -r case/{0.orig,system}
