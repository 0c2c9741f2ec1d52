// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#include "caromPatches.H"
#include "Time.H"
#include "wordRe.H"

namespace
{

const Foam::Enum<Foam::caromPatches::kind> kindNames
({
    {Foam::caromPatches::kind::none, "none"},
    {Foam::caromPatches::kind::escape, "escape"},
    {Foam::caromPatches::kind::stick, "stick"},
    {Foam::caromPatches::kind::rebound, "rebound"},
    {Foam::caromPatches::kind::law, "law"},
});

//- Entries that a kind takes, beside 'type'
Foam::wordHashSet keywords(const Foam::caromPatches::kind kind)
{
    switch (kind)
    {
        case Foam::caromPatches::kind::law: return {"type", "law", "file", "name"};
        case Foam::caromPatches::kind::rebound: return {"type", "e", "mu"};
        default: return {"type"};
    }
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
    result.what = kindNames.get("type", dict);

    const wordHashSet allowed(keywords(result.what));
    for (const word& key : dict.toc())
    {
        if (!allowed.found(key))
        {
            FatalIOErrorInFunction(dict)
                << "Unknown keyword '" << key << "' in the entry of patch '" << patch.keyword() << "': type "
                << kindNames[result.what] << " takes " << flatOutput(allowed.sortedToc()) << nl
                << exit(FatalIOError);
        }
    }

    if (result.what == kind::law)
    {
        result.law = caromLaw(patch, materials, caseDir);
    }
    else if (result.what == kind::rebound)
    {
        result.e = dict.getCheckOrDefault<scalar>("e", 1, [](const scalar x) { return x >= 0 && x <= 1; });
        result.mu = dict.getCheckOrDefault<scalar>("mu", 0, [](const scalar x) { return x >= 0 && x <= 1; });
    }

    return result;
}


const Foam::entry* Foam::caromPatches::find(const dictionary& patches, const polyPatch& pp)
{
    if (const entry* byName = patches.findEntry(pp.name(), keyType::LITERAL))
    {
        return byName;
    }

    for (const word& group : pp.inGroups())
    {
        if (const entry* byGroup = patches.findEntry(group, keyType::LITERAL))
        {
            return byGroup;
        }
    }

    return patches.findEntry(pp.name(), keyType::REGEX);
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

        if (mesh.indices(e.keyword()).empty())
        {
            FatalIOErrorInFunction(e.dict())
                << "Entry '" << e.keyword() << "' of patches matches no patch or patch group of the mesh. Patches: "
                << flatOutput(mesh.names()) << nl << exit(FatalIOError);
        }
    }
}


Foam::caromPatches::caromPatches(const dictionary& coeffs, const polyMesh& mesh)
:
    actions_(1),
    entryOfPatch_(mesh.boundaryMesh().nNonProcessor(), Zero),
    names_(),
    rowOfPatch_(entryOfPatch_.size(), -1)
{
    const polyBoundaryMesh& boundary = mesh.boundaryMesh();
    const dictionary& patches = coeffs.subDict("patches");
    const fileName caseDir(mesh.time().globalPath());
    const fileName materials(coeffs.getOrDefault<fileName>("materials", fileName::null));

    checkNames(patches, boundary);

    DynamicList<const entry*> read;
    DynamicList<word> names, missing;

    forAll(entryOfPatch_, patchi)
    {
        const polyPatch& pp = boundary[patchi];
        const entry* found = find(patches, pp);

        if (found)
        {
            label i = read.find(found);
            if (i < 0)
            {
                i = read.size();
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
            << "No entry for patch" << (missing.size() > 1 ? "es " : " ") << flatOutput(missing)
            << ". Each patch needs one of type " << flatOutput(kindNames.sortedToc()) << nl << exit(FatalIOError);
    }

    names_.transfer(names);
}
