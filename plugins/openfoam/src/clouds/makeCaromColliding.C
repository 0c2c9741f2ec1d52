// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#ifdef OPENFOAM
    #include "basicKinematicCollidingCloud.H"
#else
    #include "collidingCloud.H"
#endif
#include "CaromInteraction.H"

#ifdef OPENFOAM
    makePatchInteractionModelType(CaromInteraction, basicKinematicCollidingCloud);
#else
    makePatchInteractionModelType(CaromInteraction, collidingCloud);
#endif
