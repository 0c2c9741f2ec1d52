// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#include "caromImpactLog.H"
#include "caromRelease.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "error.H"

#include <limits>

namespace
{

void write3(std::ostream& os, const double* v)
{
    os << ',' << v[0] << ',' << v[1] << ',' << v[2];
}

} // End anonymous namespace


Foam::caromImpactLog::caromImpactLog(const Time& time, const word& cloudName)
{
    const fileName dir
    (
        time.globalPath()/word("postProcessing")/"lagrangian"/cloudName/"impacts"/caromRelease::timeName(time)
    );
    mkDir(dir);

    const word rank(Pstream::parRun() ? "_processor" + Foam::name(Pstream::myProcNo()) : "");
    path_ = dir/("impacts" + rank + ".csv");

    file_.open(path_.c_str());
    check();

    file_.precision(std::numeric_limits<double>::max_digits10);
    file_
        << "time,patch,x,y,z,diameter,density,vx,vy,vz,wx,wy,wz,nx,ny,nz,ux,uy,uz,draw0,draw1,draw2,draw3,"
        << "fate,vx_out,vy_out,vz_out,wx_out,wy_out,wz_out,restitution,impulse_ratio\n";
}


Foam::caromImpactLog::~caromImpactLog()
{
    // what the buffer still holds is written here
    file_.close();
    check();
}


void Foam::caromImpactLog::check() const
{
    if (!file_)
    {
        FatalErrorInFunction << "Cannot write " << path_ << " (logImpacts)" << exit(FatalError);
    }
}


void Foam::caromImpactLog::write
(
    const scalar time,
    const word& patch,
    const vector& position,
    const carom_impact_in& in,
    const carom_impact_out& out,
    const vector& velocity
)
{
    const double at[3] = {position.x(), position.y(), position.z()};
    const double after[3] = {velocity.x(), velocity.y(), velocity.z()};

    file_ << time << ',' << patch;
    write3(file_, at);
    file_ << ',' << in.diameter << ',' << in.density;
    write3(file_, in.velocity);
    write3(file_, in.spin);
    write3(file_, in.normal);
    write3(file_, in.wall_velocity);
    write3(file_, in.draws);
    file_ << ',' << in.draws[3] << ',' << (out.fate == CAROM_FATE_CAPTURE ? "capture" : "rebound");
    write3(file_, after);
    write3(file_, out.spin);
    file_ << ',' << out.restitution << ',' << out.impulse_ratio << '\n';
    check();
}
