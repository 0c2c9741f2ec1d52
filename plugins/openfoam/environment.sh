# For a shell that runs cases with the plug-in:  . plugins/openfoam/environment.sh
# Sets what Debian's OpenFOAM needs (WM_PROJECT_DIR) and where the plug-in lies (LD_LIBRARY_PATH, CAROM_LIBBIN).

CAROM_LIBBIN=${CAROM_LIBBIN:-$(cd "$(dirname "${BASH_SOURCE[0]:-$0}")" && pwd)/lib}
WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
case ":${LD_LIBRARY_PATH:-}:" in
    *":$CAROM_LIBBIN:"*) ;;
    *) LD_LIBRARY_PATH=$CAROM_LIBBIN${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} ;;
esac
export CAROM_LIBBIN WM_PROJECT_DIR LD_LIBRARY_PATH
