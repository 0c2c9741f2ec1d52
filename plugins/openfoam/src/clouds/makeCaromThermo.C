// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#ifdef OPENFOAM
    #include "basicThermoCloud.H"
#else
    #include "thermoCloud.H"
#endif
#include "CaromInteraction.H"

#ifdef OPENFOAM
    makePatchInteractionModelType(CaromInteraction, basicThermoCloud);
#else
    makePatchInteractionModelType(CaromInteraction, thermoCloud);
#endif
