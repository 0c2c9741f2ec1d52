// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

// A cloud that ESI's releases alone have

#ifdef OPENFOAM

#include "basicHeterogeneousReactingCloud.H"
#include "CaromInteraction.H"

makePatchInteractionModelType(CaromInteraction, basicHeterogeneousReactingCloud);

#endif
