// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#ifdef OPENFOAM
    #include "basicReactingCloud.H"
#else
    #include "reactingCloud.H"
#endif
#include "CaromInteraction.H"

#ifdef OPENFOAM
    makePatchInteractionModelType(CaromInteraction, basicReactingCloud);
#else
    makePatchInteractionModelType(CaromInteraction, reactingCloud);
#endif
