// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#ifdef OPENFOAM
    #include "basicReactingMultiphaseCloud.H"
#else
    #include "reactingMultiphaseCloud.H"
#endif
#include "CaromInteraction.H"

#ifdef OPENFOAM
    makePatchInteractionModelType(CaromInteraction, basicReactingMultiphaseCloud);
#else
    makePatchInteractionModelType(CaromInteraction, reactingMultiphaseCloud);
#endif
