/* The same impacts as cost.rs through the C interface, over and over; benches/c-interface.sh counts and times them. */
#include <carom.h>

#include <stdio.h>
#include <stdlib.h>

#define ROWS 512

static const char wall[] =
    "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nnormal = \"ea\"\nfriction = 0.2\nroughness_factor = 0.15\n"
    "adhesion_damping = 1.3\nhertz_damping = 0.007\n";

static double at(size_t i, size_t k)
{
    return (double)((i * 2654435761u + k * 40503u * (i % 97u + 1u)) % 65536u) / 65536.0;
}

int main(int argc, char **argv)
{
    static carom_impact_in in[ROWS];
    static carom_impact_out out[ROWS];
    const long rounds = argc > 1 ? atol(argv[1]) : 1000;
    const int batch = argc > 2 && argv[2][0] == 'b', columns = argc > 2 && argv[2][0] == 'c';
    static double normal[ROWS], tangential[ROWS], spin[ROWS], diameter[ROWS], n_out[ROWS], t_out[ROWS], s_out[ROWS];
    carom_law *law = NULL;
    double sum = 0.0;
    size_t i;
    long round;

    if (carom_law_from_text(wall, NULL, NULL, &law) != CAROM_STATUS_OK) {
        fprintf(stderr, "%s\n", carom_last_error());
        return 1;
    }
    for (i = 0; i < ROWS; i++) {
        in[i].size = sizeof in[i];
        out[i].size = sizeof out[i];
        in[i].diameter = 20e-6 + 100e-6 * at(i, 1);
        in[i].velocity[0] = 10.0 * at(i, 2);
        in[i].velocity[1] = -0.1 - 10.0 * at(i, 3);
        in[i].spin[2] = 2e4 * (at(i, 4) - 0.5);
        in[i].normal[1] = 1.0;
        normal[i] = -in[i].velocity[1];
        tangential[i] = in[i].velocity[0];
        spin[i] = -in[i].spin[2];
        diameter[i] = in[i].diameter;
    }
    for (round = 0; round < rounds; round++) {
        if (batch) {
            carom_impact_batch(law, ROWS, in, out, NULL);
        } else if (columns) {
            carom_impact_columns(law, ROWS, normal, tangential, spin, diameter, n_out, t_out, s_out, NULL, NULL, NULL);
        } else {
            for (i = 0; i < ROWS; i++) {
                carom_impact(law, &in[i], &out[i]);
            }
        }
        sum += columns ? n_out[(size_t)round % ROWS] : out[(size_t)round % ROWS].velocity[1];
    }
    printf("sum %.9g\n", sum);
    carom_law_free(law);
    return 0;
}
