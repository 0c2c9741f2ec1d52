// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#include "caromLaw.H"
#include "caromRelease.H"
#include "error.H"
#include "IOstreams.H"

#include <fstream>
#include <sstream>

namespace
{

//- A file of the case, as the C library wants it
Foam::string path(Foam::fileName file, const Foam::fileName& caseDir)
{
    file.expand();
    return file.isAbsolute() ? file : caseDir/file;
}

Foam::string contents(const Foam::dictionary& entry, const Foam::string& file)
{
    std::ifstream in(file.c_str());
    std::ostringstream text;
    if (!in || !(text << in.rdbuf()))
    {
        FatalIOErrorInFunction(entry)
            << "Cannot read materials " << file << Foam::nl << Foam::exit(Foam::FatalIOError);
    }
    return text.str();
}

const char* orNull(const Foam::string& text)
{
    return text.empty() ? nullptr : text.c_str();
}

} // End anonymous namespace


Foam::caromLaw::caromLaw()
:
    law_(),
    scatters_(false)
{}


Foam::caromLaw::caromLaw(const entry& patch, const fileName& materials, const fileName& caseDir)
:
    law_(),
    scatters_(false)
{
    const dictionary& dict = patch.dict();

    if (dict.found("law") == dict.found("file"))
    {
        FatalIOErrorInFunction(dict)
            << "The entry of patch '" << patch.keyword() << "' needs either 'law' (a wall law as text, #{ ... #}) or"
            << " 'file' (a file with wall laws) and 'name'" << nl << exit(FatalIOError);
    }

    const string name(caromRelease::getOr(dict, "name", word::null));
    const string materialsPath(materials.empty() ? string() : path(materials, caseDir));

    const quietFloat quiet;
    carom_law* law = nullptr;
    carom_status status;
    if (dict.found("file"))
    {
        const string file(path(caromRelease::get<fileName>(dict, "file"), caseDir));
        status = carom_law_from_file(file.c_str(), orNull(name), orNull(materialsPath), &law);
    }
    else
    {
        const string text(caromRelease::get<string>(dict, "law"));
        const string materialsText(materials.empty() ? string() : contents(dict, materialsPath));
        status = carom_law_from_text(text.c_str(), orNull(name), orNull(materialsText), &law);
    }

    if (status != CAROM_STATUS_OK)
    {
        FatalIOErrorInFunction(dict)
            << "The wall law of patch entry '" << patch.keyword() << "' cannot be used:" << nl
            << carom_last_error() << nl << exit(FatalIOError);
    }

    law_.reset(static_cast<const carom_law*>(law), [law](const carom_law*) { carom_law_free(law); });
    scatters_ = carom_law_scatters(law) == 1;
}


carom_impact_in Foam::caromLaw::input()
{
    carom_impact_in in = carom_impact_in();
    in.size = sizeof(in);
    for (double& draw : in.draws)
    {
        draw = 0.5;
    }
    return in;
}


void Foam::caromLaw::refuse(const carom_impact_in& in)
{
    FatalErrorInFunction
        << "No answer to the impact of a sphere of diameter " << in.diameter << " m and density " << in.density
        << " kg/m3 at velocity (" << in.velocity[0] << ' ' << in.velocity[1] << ' ' << in.velocity[2] << "): "
        << carom_last_error() << abort(FatalError);
}
