/* The interface as C sees it: layout, answers, statuses, messages, threads. Run by run.sh, also under valgrind. */
#include <carom.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures;

static void expect(int holds, const char *what, int line)
{
    if (!holds) {
        fprintf(stderr, "line %d: %s (last message: %s)\n", line, what, carom_last_error());
        failures++;
    }
}
#define EXPECT(condition) expect((condition) ? 1 : 0, #condition, __LINE__)

static const char glass[] =
    "[law.glass]\nsphere = \"copper\"\nsurface = \"glass\"\nnormal = \"ea\"\nfriction = 0.2\n";

static carom_impact_in oblique(void)
{
    carom_impact_in in = {0};
    in.size = sizeof in;
    in.diameter = 90e-6;
    in.velocity[0] = 2.0;
    in.velocity[1] = -0.5;
    in.normal[1] = 1.0;
    return in;
}

static carom_impact_out blank(void)
{
    carom_impact_out out = {0};
    out.size = sizeof out;
    return out;
}

static double sum(const carom_energy *e)
{
    return e->adhesion + e->adhesion_damping + e->hertz_damping + e->plastic + e->other + e->friction + e->captured
        + e->kept;
}

static void rebounds_and_captures(const carom_law *law)
{
    carom_impact_in in = oblique();
    carom_impact_out out = blank();
    double capture = 0.0, slope;

    EXPECT(carom_impact(law, &in, &out) == CAROM_STATUS_OK);
    EXPECT(out.fate == CAROM_FATE_REBOUND && out.contact == CAROM_CONTACT_SLIDING);
    /* an elastic law, faster than copper stays elastic; nothing else is to be said */
    EXPECT(carom_validity_name(out.validity) != NULL && strcmp(carom_validity_name(out.validity), "above-yield") == 0);
    EXPECT(strcmp(carom_fate_name(out.fate), "rebound") == 0);
    EXPECT(strcmp(carom_contact_name(out.contact), "sliding") == 0);
    /* the normal speed is e times the incoming one; it slides: the tangential impulse is f times the normal one,
       and spins the sphere up by 5/2 of it over the radius */
    EXPECT(fabs(out.velocity[1] - 0.5 * out.restitution) < 1e-15);
    EXPECT(fabs(2.0 - out.velocity[0] - 0.2 * 0.5 * (1.0 + out.restitution)) < 1e-14);
    EXPECT(fabs(out.spin[2] + 2.5 * (2.0 - out.velocity[0]) / 45e-6) < 1e-9);
    EXPECT(fabs(out.impulse_ratio - 0.2) < 1e-15);
    slope = out.velocity[0] / 2.0;
    EXPECT(fabs(out.tangential_restitution - slope) < 1e-15);
    EXPECT(fabs(sum(&out.energy) - 1.0) < 1e-14);

    /* a wall that moves along carries it away; the frame makes no difference */
    in.wall_velocity[0] = 10.0;
    in.velocity[0] += 10.0;
    EXPECT(carom_impact(law, &in, &out) == CAROM_STATUS_OK);
    EXPECT(fabs(out.velocity[0] - 10.0 - 2.0 * slope) < 1e-13);

    /* what `carom capture --sphere copper --surface glass --diameter 10um` prints */
    EXPECT(carom_capture_velocity(law, 10e-6, 0.0, 1.5707963267948966, &capture) == CAROM_STATUS_OK);
    EXPECT(fabs(capture - 0.7551) < 5e-5);
    in = oblique();
    in.diameter = 10e-6;
    EXPECT(carom_impact(law, &in, &out) == CAROM_STATUS_OK && out.fate == CAROM_FATE_CAPTURE);
    EXPECT(out.restitution == 0.0 && out.velocity[0] == 0.0 && isnan(out.impulse_ratio) && out.energy.captured > 0.0);
}

static void refusals(const carom_law *law)
{
    carom_impact_in in = oblique();
    carom_impact_out out = blank();
    carom_impact_in ins[3];
    carom_impact_out outs[3];
    size_t failed = 9, i;
    carom_law *none = NULL;

    in.velocity[1] = 0.5;
    EXPECT(carom_impact(law, &in, &out) == CAROM_STATUS_NOT_APPROACHING);
    EXPECT(out.fate == CAROM_FATE_UNMET && out.velocity[0] == 2.0 && out.velocity[1] == 0.5);
    in = oblique();
    in.diameter = -1.0;
    EXPECT(carom_impact(law, &in, &out) == CAROM_STATUS_BAD_IMPACT);
    EXPECT(strstr(carom_last_error(), "diameter") != NULL);
    in = oblique();
    in.size = 0;
    EXPECT(carom_impact(law, &in, &out) == CAROM_STATUS_BAD_ARGUMENT);
    EXPECT(strstr(carom_last_error(), "carom_impact_in") != NULL);
    EXPECT(carom_impact(NULL, &in, &out) == CAROM_STATUS_BAD_ARGUMENT);

    for (i = 0; i < 3; i++) {
        ins[i] = oblique();
        outs[i] = blank();
    }
    EXPECT(carom_impact_batch(law, 3, ins, outs, &failed) == CAROM_STATUS_OK && failed == 3);
    ins[1].velocity[1] = 1.0;
    EXPECT(carom_impact_batch(law, 3, ins, outs, &failed) == CAROM_STATUS_NOT_APPROACHING && failed == 1);
    EXPECT(outs[0].fate == CAROM_FATE_REBOUND && outs[1].fate == CAROM_FATE_UNMET && outs[2].fate == outs[0].fate);

    EXPECT(carom_law_from_text("normal = \"eaa\"\n", NULL, NULL, &none) == CAROM_STATUS_BAD_LAW && none == NULL);
    EXPECT(strncmp(carom_last_error(), "law:1:10: ", 10) == 0 && strstr(carom_last_error(), "^^^^^") != NULL);
    EXPECT(carom_law_from_file("no/such/file.toml", "a", NULL, &none) == CAROM_STATUS_FILE);
    EXPECT(strcmp(carom_last_error(), "no/such/file.toml: No such file or directory") == 0);
}

static void columns(const carom_law *law)
{
    const double normal[3] = {0.5, 0.01, 2.0}, tangential[3] = {2.0, 2.0, -1.0}, spin[3] = {0.0, 0.0, 1e3};
    const double diameter[3] = {90e-6, 90e-6, 90e-6};
    double n[3], t[3], s[3], e[3], mu[3];
    carom_impact_in in = oblique();
    carom_impact_out out = blank();
    size_t failed = 9;

    EXPECT(carom_impact_columns(law, 3, normal, tangential, spin, diameter, n, t, s, e, mu, &failed) == CAROM_STATUS_OK);
    EXPECT(failed == 3 && carom_impact(law, &in, &out) == CAROM_STATUS_OK);
    EXPECT(n[0] == out.velocity[1] && t[0] == out.velocity[0] && s[0] == -out.spin[2] && e[0] == out.restitution);
    EXPECT(n[1] == 0.0 && t[1] == 0.0 && s[1] == 0.0 && isnan(mu[1]) && n[2] > 1.0);
}

/* what a program does that was compiled when the structs were shorter */
static void shorter_structs(const carom_law *law)
{
    struct {
        size_t size;
        double diameter, density, velocity[3], spin[3], normal[3];
    } in = {0};
    struct {
        size_t size;
        int32_t fate, contact;
        double velocity[3], spin[3], restitution, impulse_ratio, tangential_restitution;
    } out = {0};
    carom_impact_in whole = oblique();
    carom_impact_out answer = blank();

    in.size = sizeof in;
    out.size = sizeof out;
    in.diameter = whole.diameter;
    memcpy(in.velocity, whole.velocity, sizeof in.velocity);
    memcpy(in.normal, whole.normal, sizeof in.normal);
    EXPECT(carom_impact(law, &whole, &answer) == CAROM_STATUS_OK);
    EXPECT(carom_impact(law, (const carom_impact_in *)&in, (carom_impact_out *)&out) == CAROM_STATUS_OK);
    EXPECT(memcmp(out.velocity, answer.velocity, sizeof out.velocity) == 0 && out.fate == answer.fate);
}

static void *many(void *law)
{
    carom_impact_in in = oblique();
    carom_impact_out out = blank();
    double *total = malloc(sizeof *total);
    int i;

    if (total == NULL) {
        return NULL;
    }
    *total = 0.0;
    for (i = 1; i <= 1000; i++) {
        in.velocity[1] = -0.01 * i;
        if (carom_impact((const carom_law *)law, &in, &out) == CAROM_STATUS_OK) {
            *total += out.velocity[1];
        }
    }
    in.velocity[1] = 1.0;
    if (carom_impact((const carom_law *)law, &in, &out) != CAROM_STATUS_NOT_APPROACHING) {
        *total = -1.0;
    }
    return total;
}

static void threads(carom_law *law)
{
    pthread_t thread[4];
    void *total[4];
    int i;

    for (i = 0; i < 4; i++) {
        EXPECT(pthread_create(&thread[i], NULL, many, law) == 0);
    }
    for (i = 0; i < 4; i++) {
        EXPECT(pthread_join(thread[i], &total[i]) == 0);
        EXPECT(total[i] != NULL && *(double *)total[i] > 0.0 && *(double *)total[i] == *(double *)total[0]);
    }
    for (i = 0; i < 4; i++) {
        free(total[i]);
    }
}

int main(void)
{
    carom_law *law = NULL;
    uint64_t bit;
    int named = 0;

    EXPECT(strcmp(carom_last_error(), "") == 0);
    EXPECT(carom_law_from_text(glass, "glass", NULL, &law) == CAROM_STATUS_OK);
    if (law == NULL) {
        return EXIT_FAILURE;
    }
    EXPECT(carom_law_density(law) > 8000.0);
    EXPECT(carom_law_scatters(law) == 0 && carom_law_scatters(NULL) == -1);
    rebounds_and_captures(law);
    refusals(law);
    columns(law);
    shorter_structs(law);
    threads(law);
    for (bit = 1; bit != 0; bit <<= 1) {
        named += carom_validity_name(bit) != NULL && carom_validity_meaning(bit) != NULL;
    }
    EXPECT(named >= 8);
    EXPECT(carom_fate_name(7) == NULL && carom_contact_name(-2) == NULL && carom_version()[0] != 0);
    carom_law_free(law);
    carom_law_free(NULL);
    printf("carom %s: %s\n", carom_version(), failures == 0 ? "all holds" : "FAILED");
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
