/* A copper sphere hits glass: cc impact.c $(pkg-config --cflags --libs carom) -o impact */
#include <carom.h>

#include <stdio.h>
#include <stdlib.h>

static const char walls[] =
    "[law.glass]\n"
    "sphere = \"copper\"\n"
    "surface = \"glass\"\n"
    "normal = \"ea\"\n"
    "friction = 0.2\n"
    "roughness_factor = 0.8\n";

static void check(carom_status status)
{
    if (status != CAROM_STATUS_OK) {
        fprintf(stderr, "%s\n", carom_last_error());
        exit(EXIT_FAILURE);
    }
}

int main(void)
{
    carom_law *glass = NULL;
    double capture = 0.0;
    carom_impact_in in = {0}; /* no spin, the law's own density, a wall at rest */
    carom_impact_out out = {0};

    check(carom_law_from_text(walls, "glass", NULL, &glass));

    in.size = sizeof in;
    out.size = sizeof out;
    in.diameter = 90e-6;
    in.velocity[0] = 2.0;
    in.velocity[1] = -0.5;
    in.normal[1] = 1.0;
    check(carom_impact(glass, &in, &out));
    printf("%s, %s: e = %.4f, mu = %.4f\n", carom_fate_name(out.fate), carom_contact_name(out.contact),
           out.restitution, out.impulse_ratio);
    printf("leaves at (%.4f, %.4f, %.4f) m/s, spinning (%.0f, %.0f, %.0f) rad/s\n", out.velocity[0], out.velocity[1],
           out.velocity[2], out.spin[0], out.spin[1], out.spin[2]);

    check(carom_capture_velocity(glass, in.diameter, 0.0, 1.5707963267948966, &capture));
    printf("below %.4f m/s it sticks\n", capture);

    carom_law_free(glass);
    return 0;
}
