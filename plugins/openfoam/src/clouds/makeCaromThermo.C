// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#include "basicThermoCloud.H"
#include "CaromInteraction.H"

makePatchInteractionModelType(CaromInteraction, basicThermoCloud);
