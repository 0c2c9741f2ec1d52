// Part of carom's OpenFOAM plug-in. GPL-3.0-or-later, see ../../COPYING.

#include "caromCounts.H"
#include "caromRelease.H"
#include "Pstream.H"
#include "PstreamCombineReduceOps.H"

#include <algorithm>

constexpr int Foam::caromCounts::kinds;

const char* const Foam::caromCounts::names[Foam::caromCounts::kinds] = {"rebound", "capture", "escape"};


Foam::word Foam::caromCounts::key(const char* quantity, const int kind)
{
    word name(names[kind]);
    name[0] = toupper(name[0]);
    return quantity + name;
}


Foam::caromCounts::caromCounts(const wordList& patches)
:
    patches_(patches)
{
    clear();
}


void Foam::caromCounts::clear()
{
    for (int kind = 0; kind < kinds; ++kind)
    {
        number_[kind] = List<int64_t>(patches_.size(), int64_t(0));
        mass_[kind] = scalarList(patches_.size(), 0.0);
    }
}


Foam::caromCounts Foam::caromCounts::total() const
{
    caromCounts sum(*this);
    for (int kind = 0; kind < kinds; ++kind)
    {
        Pstream::listCombineGather(sum.number_[kind], plusEqOp<int64_t>());
        Pstream::listCombineScatter(sum.number_[kind]);
        Pstream::listCombineGather(sum.mass_[kind], plusEqOp<scalar>());
        Pstream::listCombineScatter(sum.mass_[kind]);
    }
    return sum;
}


void Foam::caromCounts::addFrom(const dictionary& dict)
{
    const wordList then(caromRelease::getOr(dict, "patches", wordList()));

    for (int kind = 0; kind < kinds; ++kind)
    {
        const List<int64_t> number(caromRelease::getOr(dict, key("n", kind), List<int64_t>()));
        const scalarList mass(caromRelease::getOr(dict, key("mass", kind), scalarList()));

        forAll(then, i)
        {
            const label row = label(std::find(patches_.begin(), patches_.end(), then[i]) - patches_.begin());
            if (row < patches_.size() && i < number.size() && i < mass.size())
            {
                number_[kind][row] += number[i];
                mass_[kind][row] += mass[i];
            }
        }
    }
}


Foam::dictionary Foam::caromCounts::entries() const
{
    dictionary dict;
    dict.add("patches", patches_);
    for (int kind = 0; kind < kinds; ++kind)
    {
        dict.add(key("n", kind), number_[kind]);
        dict.add(key("mass", kind), mass_[kind]);
    }
    return dict;
}


void Foam::caromCounts::report(Ostream& os) const
{
    forAll(patches_, row)
    {
        os  << "    Parcel fate: patch " << patches_[row] << " (number, mass)" << nl;
        for (int kind = 0; kind < kinds; ++kind)
        {
            const word name(names[kind]);
            os  << "      - " << name.c_str() << string(28 - name.size(), ' ').c_str() << "= "
                << number_[kind][row] << ", " << mass_[kind][row] << nl;
        }
    }
}


Foam::wordList Foam::caromCounts::titles() const
{
    DynamicList<word> titles;
    for (const word& patch : patches_)
    {
        for (int kind = 0; kind < kinds; ++kind)
        {
            titles.append(patch + '_' + key("n", kind));
            titles.append(patch + '_' + key("mass", kind));
        }
    }
    wordList list;
    list.transfer(titles);
    return list;
}


void Foam::caromCounts::row(Ostream& os) const
{
    forAll(patches_, row)
    {
        for (int kind = 0; kind < kinds; ++kind)
        {
            os  << token::TAB << number_[kind][row] << token::TAB << mass_[kind][row];
        }
    }
}
