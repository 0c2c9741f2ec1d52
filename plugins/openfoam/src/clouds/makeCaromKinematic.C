// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#ifdef OPENFOAM
    #include "basicKinematicCloud.H"
#else
    #include "momentumCloud.H"
#endif
#include "CaromInteraction.H"

#ifdef OPENFOAM
    makePatchInteractionModelType(CaromInteraction, basicKinematicCloud);
#else
    makePatchInteractionModelType(CaromInteraction, momentumCloud);
#endif
