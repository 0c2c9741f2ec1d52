// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#include "CaromInteraction.H"
#include "caromRelease.H"
#include "caromSpin.H"

template<class CloudType>
Foam::CaromInteraction<CloudType>::CaromInteraction(const dictionary& dict, CloudType& owner)
:
    PatchInteractionModel<CloudType>(dict, owner, typeName),
    patches_(this->coeffDict(), owner.mesh()),
    counts_(patches_.names()),
    draws_(owner.name()),
    fields_(),
    log_()
{
    if (caromRelease::getOr(this->coeffDict(), "writeFields", false))
    {
        fields_ = std::make_shared<caromFields>(owner.mesh(), owner.name());
    }

    if (caromRelease::getOr(this->coeffDict(), "logImpacts", false))
    {
        log_ = std::make_shared<caromImpactLog>(owner.mesh().time(), owner.name());
    }
}


template<class CloudType>
Foam::CaromInteraction<CloudType>::CaromInteraction(const CaromInteraction<CloudType>& other)
:
    PatchInteractionModel<CloudType>(other),
    patches_(other.patches_),
    counts_(other.counts_),
    draws_(other.draws_),
    fields_(other.fields_),
    log_(other.log_)
{}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::stop(parcelType& p) const
{
    caromRelease::stop(p);
    p.U() = Zero;
    caromSpin::set(p, Zero);
}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::recordImpact
(
    const parcelType& p,
    const polyPatch& pp,
    const vector& nw,
    const vector& relative
)
{
    const scalar normal = relative & nw;
    fields_->addImpact
    (
        pp.index(),
        pp.whichFace(p.face()),
        p.nParticle(),
        max(normal, scalar(0)),
        mag(relative - normal*nw)
    );
}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::capture(parcelType& p, const polyPatch& pp)
{
    const scalar mass = p.nParticle()*p.mass();

    stop(p);
    counts_.add(caromCounts::capture, patches_.row(pp.index()), mass);
    if (fields_)
    {
        fields_->addCaptured(pp.index(), pp.whichFace(p.face()), mass);
    }
}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::escape(parcelType& p, const polyPatch& pp)
{
    stop(p);
    counts_.add(caromCounts::escape, patches_.row(pp.index()), p.nParticle()*p.mass());
}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::rebound
(
    parcelType& p,
    const polyPatch& pp,
    const caromPatches::action& action
)
{
    vector nw, Up;
    this->owner().patchData(p, pp, nw, Up);

    vector U(p.U() - Up);
    const scalar Un = U & nw;
    const vector Ut(U - Un*nw);

    if (fields_)
    {
        recordImpact(p, pp, nw, U);
    }

    if (Un > 0)
    {
        U -= (1 + action.e)*Un*nw;
    }
    U -= action.mu*Ut;

    p.U() = U + Up;
    counts_.add(caromCounts::rebound, patches_.row(pp.index()), p.nParticle()*p.mass());
}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::impact
(
    parcelType& p,
    const polyPatch& pp,
    const caromPatches::action& action
)
{
    vector nw, Up;
    this->owner().patchData(p, pp, nw, Up);

    const vector relative(p.U() - Up);
    if ((relative & nw) <= 0)
    {
        // Forces have turned the parcel between the flight and the wall: it leaves by itself
        return;
    }

    carom_impact_in in = caromLaw::input();
    in.diameter = p.d();
    in.density = p.rho();
    const vector spin(caromSpin::get(p));
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        in.velocity[i] = p.U()[i];
        in.spin[i] = spin[i];
        in.normal[i] = -nw[i];  // ours points into the fluid
        in.wall_velocity[i] = Up[i];
    }
    if (action.law.scatters())
    {
        draws_.draw(this->owner().mesh().time().timeIndex(), p.origProc(), p.origId(), pp.index(), in.draws);
    }

    const carom_impact_out out(action.law.impact(in));
    if (out.fate == CAROM_FATE_UNMET)
    {
        return;
    }

    if (fields_)
    {
        recordImpact(p, pp, nw, relative);
    }

    if (out.fate == CAROM_FATE_CAPTURE)
    {
        capture(p, pp);
    }
    else
    {
        p.U() = vector(out.velocity[0], out.velocity[1], out.velocity[2]);
        caromSpin::set(p, vector(out.spin[0], out.spin[1], out.spin[2]));
        counts_.add(caromCounts::rebound, patches_.row(pp.index()), p.nParticle()*p.mass());
    }

    if (log_)
    {
        const Time& time = this->owner().mesh().time();
        const scalar t = time.value() - (1 - p.stepFraction())*time.deltaTValue();
        log_->write(t, pp.name(), caromRelease::position(p, this->owner().mesh()), in, out, p.U());
    }
}


template<class CloudType>
bool Foam::CaromInteraction<CloudType>::correct(parcelType& p, const polyPatch& pp, bool& keepParticle)
{
    const caromPatches::action& action = patches_[pp.index()];

    keepParticle = action.what != caromPatches::kind::escape;
    switch (action.what)
    {
        case caromPatches::kind::none:
        {
            return false;
        }
        case caromPatches::kind::escape:
        {
            escape(p, pp);
            break;
        }
        case caromPatches::kind::stick:
        {
            if (fields_)
            {
                vector nw, Up;
                this->owner().patchData(p, pp, nw, Up);
                recordImpact(p, pp, nw, p.U() - Up);
            }
            capture(p, pp);
            break;
        }
        case caromPatches::kind::rebound:
        {
            rebound(p, pp, action);
            break;
        }
        case caromPatches::kind::law:
        {
            impact(p, pp, action);
            break;
        }
    }
    return true;
}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::report(Ostream& os)
{
    caromCounts total(counts_.total());
    total.addFrom
    (
        this->properties().subOrEmptyDict(this->baseName()).subOrEmptyDict(this->modelType())
    );
    total.report(os);

    #ifdef OPENFOAM
    total.row(this->file());
    this->file() << endl;
    #endif

    if (this->writeTime())
    {
        if (!this->properties_.found(this->baseName()))
        {
            this->properties_.add(this->baseName(), dictionary());
        }
        this->properties_.subDict(this->baseName()).set(this->modelType(), total.entries());
        counts_.clear();
    }
}


#ifdef OPENFOAM

template<class CloudType>
void Foam::CaromInteraction<CloudType>::writeFileHeader(Ostream& os)
{
    PatchInteractionModel<CloudType>::writeFileHeader(os);
    for (const word& title : counts_.titles())
    {
        this->writeTabbed(os, title);
    }
}

#endif


template<class CloudType>
template<class Base>
auto Foam::CaromInteraction<CloudType>::baseInfo(Ostream& os, int) -> decltype(std::declval<Base&>().info(os), void())
{
    Base::info(os);
}


template<class CloudType>
template<class Base>
auto Foam::CaromInteraction<CloudType>::baseInfo(Ostream&, long) -> decltype(std::declval<Base&>().info(), void())
{
    Base::info();
}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::info(Ostream& os)
{
    baseInfo<PatchInteractionModel<CloudType>>(os, 0);
    report(os);
}


template<class CloudType>
void Foam::CaromInteraction<CloudType>::info()
{
    info(Info);
}
