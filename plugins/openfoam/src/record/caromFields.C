// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#include "caromFields.H"
#include "caromRelease.H"
#include "mathematicalConstants.H"

namespace
{

Foam::IOobject io(const Foam::fvMesh& mesh, const Foam::word& cloud, const char* name)
{
    return Foam::IOobject
    (
        cloud + ':' + name,
        Foam::caromRelease::timeName(mesh.time()),
        mesh,
        Foam::IOobject::READ_IF_PRESENT,
        Foam::IOobject::AUTO_WRITE
    );
}

} // End anonymous namespace


Foam::caromFields::caromFields(const fvMesh& mesh, const word& cloud)
:
    massCaptured_(io(mesh, cloud, "massCaptured"), mesh, dimensionedScalar(dimMass, Zero)),
    impacts_(io(mesh, cloud, "impacts"), mesh, dimensionedScalar(dimless, Zero)),
    speed_(io(mesh, cloud, "impactSpeed"), mesh, dimensionedScalar(dimVelocity, Zero)),
    angle_(io(mesh, cloud, "impactAngle"), mesh, dimensionedScalar(dimless, Zero))
{}


void Foam::caromFields::addCaptured(const label patchi, const label facei, const scalar mass)
{
    massCaptured_.boundaryFieldRef()[patchi][facei] += mass;
}


void Foam::caromFields::addImpact
(
    const label patchi,
    const label facei,
    const scalar particles,
    const scalar normal,
    const scalar tangential
)
{
    scalar& weight = impacts_.boundaryFieldRef()[patchi][facei];
    scalar& speed = speed_.boundaryFieldRef()[patchi][facei];
    scalar& angle = angle_.boundaryFieldRef()[patchi][facei];

    weight += particles;
    if (weight > 0)
    {
        const scalar share = particles/weight;
        speed += share*(std::hypot(normal, tangential) - speed);
        angle += share*(std::atan2(normal, tangential)*(180/constant::mathematical::pi) - angle);
    }
}
