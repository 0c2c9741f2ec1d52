// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#include "caromPatches.H"
#include "caromRelease.H"
#include "Time.H"

#include <algorithm>
#include <initializer_list>

namespace
{

//- Names of the kinds, and the entries that each takes
struct kindName
{
    Foam::caromPatches::kind kind;
    const char* name;
    std::initializer_list<const char*> keywords;
};

const kindName kinds[] =
{
    {Foam::caromPatches::kind::escape, "escape", {"type"}},
    {Foam::caromPatches::kind::law, "law", {"file", "law", "name", "type"}},
    {Foam::caromPatches::kind::none, "none", {"type"}},
    {Foam::caromPatches::kind::rebound, "rebound", {"e", "mu", "type"}},
    {Foam::caromPatches::kind::stick, "stick", {"type"}}
};

const char* const kindNames = "escape, law, none, rebound, stick";

//- Names as a list in a message
template<class Names>
Foam::string listed(const Names& names)
{
    Foam::string text;
    for (const auto& name : names)
    {
        text += (text.empty() ? "" : ", ") + Foam::string(name);
    }
    return text;
}

//- A number between 0 and 1
Foam::scalar share(const Foam::dictionary& dict, const char* key, const Foam::scalar otherwise)
{
    const Foam::scalar x = Foam::caromRelease::getOr(dict, key, otherwise);
    if (!(x >= 0 && x <= 1))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << x << ": it lies between 0 and 1" << Foam::nl << exit(Foam::FatalIOError);
    }
    return x;
}

const kindName& kindOf(const Foam::entry& patch)
{
    const Foam::word type(Foam::caromRelease::get<Foam::word>(patch.dict(), "type"));
    for (const kindName& known : kinds)
    {
        if (type == known.name)
        {
            return known;
        }
    }
    FatalIOErrorInFunction(patch.dict())
        << "Unknown type '" << type << "' in the entry of patch '" << patch.keyword() << "'; known are " << kindNames
        << Foam::nl << exit(Foam::FatalIOError);
    return kinds[0];
}

} // End anonymous namespace


Foam::caromPatches::action Foam::caromPatches::read
(
    const entry& patch,
    const fileName& materials,
    const fileName& caseDir
)
{
    const dictionary& dict = patch.dict();
    action result;
    const kindName& kind = kindOf(patch);
    result.what = kind.kind;

    for (const word& key : dict.toc())
    {
        if (std::none_of(kind.keywords.begin(), kind.keywords.end(), [&key](const char* k) { return key == k; }))
        {
            FatalIOErrorInFunction(dict)
                << "Unknown keyword '" << key << "' in the entry of patch '" << patch.keyword() << "': type "
                << kind.name << " takes " << listed(kind.keywords) << nl
                << exit(FatalIOError);
        }
    }

    if (result.what == caromPatches::kind::law)
    {
        result.law = caromLaw(patch, materials, caseDir);
    }
    else if (result.what == caromPatches::kind::rebound)
    {
        result.e = share(dict, "e", 1);
        result.mu = share(dict, "mu", 0);
    }

    return result;
}


const Foam::entry* Foam::caromPatches::find(const dictionary& patches, const polyPatch& pp)
{
    if (const entry* byName = caromRelease::findName(patches, pp.name()))
    {
        return byName;
    }

    for (const word& group : pp.inGroups())
    {
        if (const entry* byGroup = caromRelease::findName(patches, group))
        {
            return byGroup;
        }
    }

    return caromRelease::findNameOrPattern(patches, pp.name());
}


void Foam::caromPatches::checkNames(const dictionary& patches, const polyBoundaryMesh& mesh)
{
    for (const entry& e : patches)
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(patches)
                << "Entry '" << e.keyword() << "' of patches is not a dictionary: " << e.keyword()
                << " { type law; ... }" << nl << exit(FatalIOError);
        }

        if (!caromRelease::fitsPatch(mesh, e.keyword()))
        {
            FatalIOErrorInFunction(e.dict())
                << "Entry '" << e.keyword() << "' of patches matches no patch or patch group of the mesh. Patches: "
                << listed(mesh.names()) << nl << exit(FatalIOError);
        }
    }
}


Foam::caromPatches::caromPatches(const dictionary& coeffs, const polyMesh& mesh)
:
    actions_(1),
    entryOfPatch_(caromRelease::nSharedPatches(mesh.boundaryMesh()), 0),
    names_(),
    rowOfPatch_(entryOfPatch_.size(), -1)
{
    const polyBoundaryMesh& boundary = mesh.boundaryMesh();
    const dictionary& patches = coeffs.subDict("patches");
    const fileName caseDir(mesh.time().globalPath());
    const fileName materials(caromRelease::getOr(coeffs, "materials", fileName()));

    checkNames(patches, boundary);

    DynamicList<const entry*> read;
    DynamicList<word> names, missing;

    forAll(entryOfPatch_, patchi)
    {
        const polyPatch& pp = boundary[patchi];
        const entry* found = find(patches, pp);

        if (found)
        {
            const label i = label(std::find(read.begin(), read.end(), found) - read.begin());
            if (i == read.size())
            {
                read.append(found);
                actions_.append(caromPatches::read(*found, materials, caseDir));
            }
            entryOfPatch_[patchi] = i + 1;

            if (actions_[i + 1].what != kind::none)
            {
                rowOfPatch_[patchi] = names.size();
                names.append(pp.name());
            }
        }
        else if (!polyPatch::constraintType(pp.type()))
        {
            missing.append(pp.name());
        }
    }

    if (missing.size())
    {
        FatalIOErrorInFunction(patches)
            << "No entry for patch" << (missing.size() > 1 ? "es " : " ") << listed(missing)
            << ". Each patch needs one of type " << kindNames << nl << exit(FatalIOError);
    }

    names_.transfer(names);
}
