// The header is C++ too: compiles as C++11 with warnings as errors, links, answers.
#include <carom.h>

#include <cstdio>
#include <memory>
#include <type_traits>

static_assert(std::is_standard_layout<carom_impact_in>::value, "a plain struct");
static_assert(std::is_standard_layout<carom_impact_out>::value, "a plain struct");
static_assert(sizeof(carom_impact_in) == 8 + 18 * 8, "no padding that differs from Rust's");
static_assert(sizeof(carom_impact_out) == 8 + 8 + 6 * 8 + 3 * 8 + 8 + 8 * 8, "no padding that differs from Rust's");

int main()
{
    carom_law *made = nullptr;
    if (carom_law_from_text("normal = \"constant\"\nrestitution = 0.5\nfriction = 0\n", nullptr, nullptr, &made)
        != CAROM_STATUS_OK) {
        std::fprintf(stderr, "%s\n", carom_last_error());
        return 1;
    }
    std::unique_ptr<carom_law, void (*)(carom_law *)> law(made, carom_law_free);
    carom_impact_in in{};
    carom_impact_out out{};
    in.size = sizeof in;
    out.size = sizeof out;
    in.diameter = 1e-4;
    in.velocity[2] = -3.0;
    in.normal[2] = 2.0;
    const carom_status status = carom_impact(law.get(), &in, &out);
    const bool fine = status == CAROM_STATUS_OK && out.fate == static_cast<int32_t>(CAROM_FATE_REBOUND)
        && out.velocity[2] == 1.5;
    std::printf("C++: %s\n", fine ? "all holds" : "FAILED");
    return fine ? 0 : 1;
}
