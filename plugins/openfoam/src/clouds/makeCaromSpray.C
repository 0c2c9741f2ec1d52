// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

// In the Foundation's releases the cloud of sprays is one of the library's; ESI's have it in a library of its own

#ifndef OPENFOAM

#include "sprayCloud.H"
#include "CaromInteraction.H"

makePatchInteractionModelType(CaromInteraction, sprayCloud);

#endif
