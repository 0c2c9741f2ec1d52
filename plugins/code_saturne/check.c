/* Every impact that code_saturne recorded, against the C interface: the same velocity, spin and fate, to the bit.
 * Usage: check WALLS.toml:LAW IMPACTS.csv... ; prints how many of each. */
#include <carom.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define VALUES 29 /* after zone and fate */

static long rebounds, captures, spinning, wrong;

static int read_row(char *line, char **zone, char **fate, double value[VALUES])
{
    char *word = strtok(line, ",");
    int i;

    *zone = word;
    *fate = strtok(NULL, ",");
    for (i = 0; i < VALUES; i++) {
        word = strtok(NULL, ",");
        if (word == NULL) {
            return 0;
        }
        value[i] = strtod(word, NULL);
    }
    return strtok(NULL, ",") == NULL;
}

/* The columns: time, mass, position, diameter, density, velocity, spin, normal, wall's velocity; velocity, spin afterwards; draws. */
static void compare(const carom_law *law, const char *zone, const char *fate, const double *v, const char *place, long row)
{
    carom_impact_in in = {0};
    carom_impact_out out;
    int fine;

    in.size = sizeof in;
    out.size = sizeof out;
    in.diameter = v[5];
    in.density = v[6];
    memcpy(in.velocity, v + 7, sizeof in.velocity);
    memcpy(in.spin, v + 10, sizeof in.spin);
    memcpy(in.normal, v + 13, sizeof in.normal);
    memcpy(in.wall_velocity, v + 16, sizeof in.wall_velocity);
    memcpy(in.draws, v + 25, sizeof in.draws);
    fine = carom_impact(law, &in, &out) == CAROM_STATUS_OK && strcmp(fate, carom_fate_name(out.fate)) == 0
        && memcmp(out.velocity, v + 19, sizeof out.velocity) == 0 && memcmp(out.spin, v + 22, sizeof out.spin) == 0;
    /* and the geometry is the channel's: at the floor or the ceiling, the normal into the air */
    if (strcmp(zone, "floor") == 0) {
        fine = fine && fabs(v[3]) < 1e-12 && fabs(v[14] - 1.0) < 1e-12 && v[8] < 0.0;
    } else {
        fine = fine && fabs(v[3] - 0.02) < 1e-12 && fabs(v[14] + 1.0) < 1e-12 && v[8] > 0.0;
    }
    if (!fine && wrong++ < 5) {
        fprintf(stderr, "%s, row %ld: is not what carom says: %s, v = (%.17g, %.17g, %.17g)\n", place, row,
                carom_fate_name(out.fate), out.velocity[0], out.velocity[1], out.velocity[2]);
    }
    *(out.fate == CAROM_FATE_CAPTURE ? &captures : &rebounds) += 1;
    spinning += v[12] != 0.0;
}

int main(int argc, char **argv)
{
    char line[4096], *zone, *fate, *colon = argc > 2 ? strrchr(argv[1], ':') : NULL;
    double value[VALUES];
    carom_law *law = NULL;
    int i;

    if (colon == NULL) {
        fprintf(stderr, "usage: check WALLS.toml:LAW IMPACTS.csv...\n");
        return 2;
    }
    *colon = '\0';
    if (carom_law_from_file(argv[1], colon + 1, NULL, &law) != CAROM_STATUS_OK) {
        fprintf(stderr, "%s\n", carom_last_error());
        return 2;
    }
    for (i = 2; i < argc; i++) {
        FILE *file = fopen(argv[i], "r");
        long row = 1;
        if (file == NULL || fgets(line, sizeof line, file) == NULL) {
            fprintf(stderr, "%s: cannot be read\n", argv[i]);
            return 2;
        }
        while (fgets(line, sizeof line, file) != NULL) {
            row++;
            line[strcspn(line, "\n")] = '\0';
            if (!read_row(line, &zone, &fate, value)) {
                fprintf(stderr, "%s, row %ld: no impact\n", argv[i], row);
                return 2;
            }
            compare(law, zone, fate, value, argv[i], row);
        }
        fclose(file);
    }
    carom_law_free(law);
    printf("rebounds %ld, captures %ld, with spin before %ld, wrong %ld\n", rebounds, captures, spinning, wrong);
    return wrong == 0 && rebounds > 100 && captures > 100 && spinning > 100 ? 0 : 1;
}
