// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#ifdef OPENFOAM
    #include "basicKinematicMPPICCloud.H"
#else
    #include "mppicCloud.H"
#endif
#include "CaromInteraction.H"

#ifdef OPENFOAM
    makePatchInteractionModelType(CaromInteraction, basicKinematicMPPICCloud);
#else
    makePatchInteractionModelType(CaromInteraction, mppicCloud);
#endif
