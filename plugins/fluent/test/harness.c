/* Plays Fluent to carom_dpm.c: particles meet walls, and what comes back is held against the C interface. See run.sh. */
#include "udf.h"

#include <carom.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void carom_loading(char *libname);
void carom_reload(void);
void carom_report(void);
void carom_reset(void);
int carom_wall(Tracked_Particle *p, Thread *t, face_t f, real normal[], int dim);
void carom_accretion(Tracked_Particle *p, Thread *t, face_t f, real normal[], real alpha, real Vmag, real mdot);
void carom_spin(cell_t c, Thread *t, int initialize, Tracked_Particle *p);

int rp_axi, rp_axi_swirl, N_UDM_of_case = 2;
Domain *domain_of_case;

static jmp_buf stopped;
static char said[8192];
static int failures;

void standin_error(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(said, sizeof said, format, arguments);
    va_end(arguments);
    longjmp(stopped, 1);
}

void standin_message(const char *format, ...)
{
    const size_t used = strlen(said);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(said + used, sizeof said - used, format, arguments);
    va_end(arguments);
}

static void expect(int holds, const char *what, int line)
{
    if (!holds) {
        fprintf(stderr, "harness.c:%d: %s (said: %s)\n", line, what, said);
        failures++;
    }
}
#define EXPECT(condition) expect((condition) ? 1 : 0, #condition, __LINE__)
#define SAYS(text) expect(strstr(said, (text)) != NULL, text, __LINE__)
/* Does it stop with an error? */
static int stops(void (*action)(void))
{
    said[0] = '\0';
    if (setjmp(stopped) == 0) {
        action();
        return 0;
    }
    return 1;
}
#define STOPS(action, text)                                        \
    do {                                                           \
        expect(stops(action), "no error of " #action, __LINE__);   \
        SAYS(text);                                                \
    } while (0)
#define GOES(action) EXPECT(!stops(action))

#ifdef STANDIN_SINGLE
#define ALMOST 1e-5
#else
#define ALMOST 1e-13
#endif

static Thread cells[3], faces[3];
static Domain domain;
static const int ids[3] = {5, 7, 8};

static void mesh(void)
{
    int i, f;
    memset(faces, 0, sizeof faces);
    memset(cells, 0, sizeof cells);
    for (i = 0; i < 3; i++) {
        faces[i].id = ids[i];
        cells[i].id = 100 + i;
        faces[i].cells = &cells[i];
        faces[i].next = i < 2 ? &faces[i + 1] : NULL;
        cells[i].next = i < 2 ? &cells[i + 1] : NULL;
        for (f = 0; f < FACES; f++) {
            faces[i].area[f][1] = (real)0.25;
        }
    }
    domain.faces = faces;
    domain.cells = cells;
    domain_of_case = &domain;
}

static uint64_t state = 20070306; /* the seed of all that is random here */
static double uniform(double low, double high)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(state >> 11) * 0x1p-53;
}

static Tracked_Particle particle(int64_t id)
{
    Tracked_Particle p;
    int i;
    memset(&p, 0, sizeof p);
    p.part_id = id;
    for (i = 0; i < 3; i++) {
        p.state.pos[i] = (real)uniform(-1.0, 1.0);
        p.state.V[i] = (real)uniform(-5.0, 5.0);
        p.user[i] = (real)uniform(-1e4, 1e4);
    }
    p.state.diam = (real)uniform(5e-6, 90e-6);
    p.state.rho = (real)uniform(8000.0, 9000.0);
    p.state.mass = (real)1e-9;
    p.flow_rate = (real)2e-6;
    p.number_in_parcel = 4;
    return p;
}

static carom_law *glass;

/* The answer the C interface itself gives, in `n` dimensions, on a wall whose normal into the fluid is `inward`. */
static carom_impact_out answer(const Tracked_Particle *p, const double inward[3], const double wall[3], int n)
{
    carom_impact_in in = {0};
    carom_impact_out out;
    int i;
    in.size = sizeof in;
    out.size = sizeof out;
    in.diameter = p->state.diam;
    in.density = p->state.rho;
    for (i = 0; i < 3; i++) {
        in.velocity[i] = i < n ? (double)p->state.V[i] : 0.0;
        in.spin[i] = p->user[i];
        in.normal[i] = inward[i];
        in.wall_velocity[i] = i < n ? wall[i] : 0.0;
    }
    EXPECT(carom_impact(glass, &in, &out) == CAROM_STATUS_OK);
    return out;
}

static void same(const Tracked_Particle *p, const carom_impact_out *out, int n, int path)
{
    int i;
    EXPECT(path == (out->fate == CAROM_FATE_CAPTURE ? PATH_ABORT : PATH_ACTIVE));
    for (i = 0; i < 3; i++) {
        if (i < n) {
            EXPECT(p->state.V[i] == (real)out->velocity[i] && p->state0.V[i] == p->state.V[i]);
        }
        EXPECT(p->user[i] == (real)out->spin[i]);
    }
}

/* On a floor (zone 5) and on a belt that moves (zone 7): to the bit. */
static void impacts_are_the_librarys(void)
{
    const double still[3] = {0.0, 0.0, 0.0}, belt[3] = {1.0, 0.0, 0.0}, up[3] = {0.0, 1.0, 0.0};
    int i, captures = 0;
    for (i = 0; i < 4000; i++) {
        Tracked_Particle p = particle(i), before;
        real out_of_domain[3] = {0, -1, 0};
        carom_impact_out out;
        int path;
        p.state.V[1] = -(real)fabs((double)p.state.V[1]);
        before = p;
        path = carom_wall(&p, &faces[i % 2], i % FACES, out_of_domain, ND_ND);
        out = answer(&before, up, i % 2 == 0 ? still : belt, ND_ND);
        same(&p, &out, ND_ND, path);
        captures += path == PATH_ABORT;
#if RP_2D
        EXPECT(p.state.V[2] == before.state.V[2]); /* not there in two dimensions */
#endif
    }
    EXPECT(captures > 100 && captures < 3900);
}

/* Whichever way the face points, and gliding along. */
static void either_side(void)
{
    Tracked_Particle a = particle(1), b;
    real down[3] = {0, -1, 0}, up[3] = {0, 1, 0};
    int i;
    a.state.V[1] = -2;
    b = a;
    EXPECT(carom_wall(&a, &faces[0], 0, down, ND_ND) == carom_wall(&b, &faces[0], 0, up, ND_ND));
    for (i = 0; i < 3; i++) {
        EXPECT(a.state.V[i] == b.state.V[i] && a.user[i] == b.user[i]);
    }
    a.state.V[1] = 0;
    b = a;
    EXPECT(carom_wall(&a, &faces[0], 0, down, ND_ND) == PATH_ACTIVE && memcmp(&a, &b, sizeof a) == 0);
}

#if RP_2D
/* A wall r = const of a case with swirl: at any azimuth, the answer is that at azimuth 0, turned. */
static void swirl(void)
{
    int i, k;
    rp_axi = rp_axi_swirl = 1;
    for (i = 0; i < 500; i++) {
        const double phi = uniform(-3.1, 3.1), c = cos(phi), s = sin(phi);
        Tracked_Particle p = particle(i), q;
        real outward[2] = {0, 1};
        double expected[3], spun[3];
        p.state.pos[1] = (real)0.1;
        p.state.pos[2] = 0;
        p.state.V[1] = (real)fabs((double)p.state.V[1]);
        q = p;
        q.state.pos[1] = (real)(0.1 * c);
        q.state.pos[2] = (real)(0.1 * s);
        q.state.V[1] = (real)(c * p.state.V[1] - s * p.state.V[2]);
        q.state.V[2] = (real)(s * p.state.V[1] + c * p.state.V[2]);
        q.user[1] = (real)(c * p.user[1] - s * p.user[2]);
        q.user[2] = (real)(s * p.user[1] + c * p.user[2]);
        EXPECT(carom_wall(&p, &faces[0], 0, outward, 2) == carom_wall(&q, &faces[0], 0, outward, 2));
        expected[0] = p.state.V[0];
        expected[1] = c * p.state.V[1] - s * p.state.V[2];
        expected[2] = s * p.state.V[1] + c * p.state.V[2];
        spun[0] = p.user[0];
        spun[1] = c * p.user[1] - s * p.user[2];
        spun[2] = s * p.user[1] + c * p.user[2];
        for (k = 0; k < 3; k++) {
            EXPECT(fabs(q.state.V[k] - expected[k]) < 20 * ALMOST);
            EXPECT(fabs(q.user[k] - spun[k]) < 1e6 * ALMOST);
        }
    }
    rp_axi = rp_axi_swirl = 0;
}
#endif

/* What sticks is on the maps: user memory by carom_wall, accretion by its own hook, called before or after. */
static void deposits(void)
{
    double mass = 0.0, rate = 0.0, hits = 0.0;
    int i, f, stuck = 0;
    char line[256];
    GOES(carom_reset);
    for (i = 0; i < 1000; i++) {
        Tracked_Particle p = particle(i);
        real down[3] = {0, -1, 0};
        double speed2 = 0.0;
        int k, path;
        real alpha, speed;
        p.state.V[1] = -(real)fabs((double)p.state.V[1]);
        for (k = 0; k < ND_ND; k++) {
            speed2 += (double)p.state.V[k] * p.state.V[k];
        }
        speed = (real)sqrt(speed2);
        alpha = (real)asin(fabs((double)p.state.V[1]) / sqrt(speed2));
        if (i % 2) {
            carom_accretion(&p, &faces[0], i % FACES, down, alpha, speed, p.flow_rate);
        }
        path = carom_wall(&p, &faces[0], i % FACES, down, ND_ND);
        if (i % 2 == 0) {
            carom_accretion(&p, &faces[0], i % FACES, down, alpha, speed, p.flow_rate);
        }
        stuck += path == PATH_ABORT;
    }
    for (f = 0; f < FACES; f++) {
        mass += 0.25 * cells[0].memory[f][0];
        hits += cells[0].memory[f][1];
        rate += 0.25 * faces[0].accretion[f];
    }
    EXPECT(stuck > 20);
    EXPECT(hits == 1000.0);
    EXPECT(fabs(mass / (stuck * 4e-9) - 1.0) < 100 * ALMOST);
    EXPECT(fabs(rate / (stuck * 2e-6) - 1.0) < 100 * ALMOST);
    GOES(carom_report);
    snprintf(line, sizeof line, "%8d %-24s %12d %12d", 5, "floor", 1000 - stuck, stuck);
    SAYS(line);
    /* a trap holds all */
    {
        Tracked_Particle p = particle(1);
        real down[3] = {0, -1, 0};
        EXPECT(carom_wall(&p, &faces[2], 0, down, ND_ND) == PATH_ABORT && cells[2].memory[0][0] > 0);
        EXPECT(faces[2].accretion[0] == 0);
        carom_accretion(&p, &faces[2], 0, down, 1, 1, (real)1e-3);
        EXPECT(fabs((double)faces[2].accretion[0] - 4e-3) < 1e-8);
    }
    GOES(carom_reset);
    EXPECT(cells[0].memory[0][0] == 0 && cells[0].memory[0][1] == 0);
}

static void *one_share(void *first)
{
    int i;
    for (i = 0; i < 20000; i++) {
        Tracked_Particle p;
        real down[3] = {0, -1, 0};
        memset(&p, 0, sizeof p);
        p.part_id = *(int *)first + i;
        p.state.V[1] = -(real)(0.01 + 0.0005 * (i % 1000));
        p.state.diam = (real)20e-6;
        p.state.rho = 8960;
        p.state.mass = (real)0.25;
        p.number_in_parcel = 1;
        carom_wall(&p, &faces[0], i % FACES, down, ND_ND);
    }
    return NULL;
}

/* As when Fluent tracks with several threads to a node: no impact is lost from counters and maps. */
static void threads(void)
{
    pthread_t thread[4];
    int first[4] = {0, 20000, 40000, 60000}, i, f;
    double hits = 0.0, mass[2] = {0.0, 0.0};
    for (i = 0; i < 2; i++) {
        GOES(carom_reset);
        for (f = 0; f < 4; f++) {
            if (i == 0) {
                one_share(&first[f]);
            } else {
                EXPECT(pthread_create(&thread[f], NULL, one_share, &first[f]) == 0);
            }
        }
        for (f = 0; i == 1 && f < 4; f++) {
            pthread_join(thread[f], NULL);
        }
        for (f = 0; f < FACES; f++) {
            hits += cells[0].memory[f][1];
            mass[i] += cells[0].memory[f][0];
        }
    }
    EXPECT(hits == 160000.0 && mass[0] == mass[1] && mass[0] > 0.0);
}

static void table(const char *text)
{
    FILE *file = fopen("table.txt", "w");
    if (file == NULL || fputs(text, file) < 0 || fclose(file) != 0) {
        perror("table.txt");
        exit(1);
    }
    setenv("CAROM_WALLS", "table.txt", 1);
}

static Tracked_Particle struck;
static Thread *wall;

static void strike(void)
{
    real down[3] = {0, -1, 0};
    carom_wall(&struck, wall, 0, down, ND_ND);
}

static void loading(void)
{
    char name[] = "libudf";
    carom_loading(name);
}

static void mistakes(void)
{
    Thread stranger = faces[0];

    struck = particle(1);
    wall = &faces[0];
    table("zone 5 floor walls.toml:glas\n");
    STOPS(carom_reload, "carom: table.txt:1: zone floor: walls.toml: no law 'glas'; did you mean glass?");
    /* and it stays said */
    STOPS(strike, "no law 'glas'");
    STOPS(carom_report, "no law 'glas'");
    table("# walls\nzone 5 floor none.toml:glass\n");
    STOPS(carom_reload, "table.txt:2: zone floor: none.toml: No such file or directory");
    table("zone 5 floor bad.toml:glass\n");
    STOPS(carom_reload, "bad.toml:2:10: unknown material 'coper'; did you mean copper?");
    SAYS("sphere = \"coper\"");
    table("zone 5 floor walls.toml:glass\nzone 6 ceiling walls.toml:glass\n");
    STOPS(carom_reload, "table.txt:2: zone 6 (ceiling) is no zone of this case");
    table("zone 5 floor walls.toml:glass\nzone 5 again trap\n");
    STOPS(carom_reload, "table.txt:2: zone 5 (again) was given before, in line 1 as floor");
    table("zone floor walls.toml:glass\n");
    STOPS(carom_reload, "table.txt:1: a zone has an id, a name and a law");
    table("zone five floor walls.toml:glass\n");
    STOPS(carom_reload, "'five' is no zone id");
    table("zone 5 floor stick\n");
    STOPS(carom_reload, "'stick' is no law; FILE:NAME, trap or escape is wanted");
    table("zone 5 floor trap velocity 1 nan 0\n");
    STOPS(carom_reload, "'nan' is no number");
    table("zones 5 floor trap\n");
    STOPS(carom_reload, "unknown entry 'zones'");
    table("deposit all 0\nzone 5 floor trap\n");
    STOPS(carom_reload, "mass or rate");
    table("deposit mass 1\nzone 5 floor trap\n");
    STOPS(carom_reload, "deposit mass 1 needs 3 user-defined memories; the case has 2");
    table("# nothing\n");
    STOPS(carom_reload, "table.txt: no zone is given");
    /* paths as Windows writes them: a drive's colon is no law's, and beside the table is behind the last back slash */
    table("zone 5 floor C:\\cases\\walls.toml\n");
    STOPS(carom_reload, "'C:\\cases\\walls.toml' is no law; FILE:NAME, trap or escape is wanted");
    table("zone 5 floor C:\\cases\\walls.toml:glass\n");
    STOPS(carom_reload, "zone floor: C:\\cases\\walls.toml: No such file or directory");
    table("zone 5 floor walls.toml:glass\n");
    if (rename("table.txt", "C:\\cases\\table.txt") == 0) {
        setenv("CAROM_WALLS", "C:\\cases\\table.txt", 1);
    }
    STOPS(carom_reload, "zone floor: C:\\cases\\walls.toml: No such file or directory");
    remove("C:\\cases\\table.txt");
    setenv("CAROM_WALLS", "no-table.txt", 1);
    STOPS(carom_reload, "no-table.txt: the table of zones cannot be opened");
    table("zone 5 floor walls.toml:glass\n");
    GOES(carom_reload);
    SAYS("1 zone(s) with wall laws from table.txt");
    stranger.id = 42;
    wall = &stranger;
    STOPS(strike, "zone 42 has carom_wall as its condition but no entry in table.txt");
    wall = &faces[0];
    struck.state.diam = -1;
    STOPS(strike, "carom: zone 5 (floor): the diameter");
    struck.user[0] = 7;
    carom_spin(0, NULL, 1, &struck);
    EXPECT(struck.user[0] == 7); /* no spin is kept */
    domain_of_case = NULL;  /* before a mesh is read, zones cannot be known */
    GOES(carom_reload);
    domain_of_case = &domain;
}

int main(void)
{
    Tracked_Particle p;
    mesh();
    EXPECT(carom_law_from_file("walls.toml", "glass", NULL, &glass) == CAROM_STATUS_OK);
    p = particle(1);
    struck = p;
    wall = &faces[0];
    STOPS(strike, "the table of zones has not been read");
    table("materials none-needed.toml\nzone 5 floor walls.toml:glass\nzone 7 belt walls.toml:glass velocity 1 0 0\n"
          "zone 8 filter trap\nspin 0 # three\ndeposit mass 0\n");
    GOES(loading);
    EXPECT(p.user[0] != 0);
    carom_spin(0, NULL, 0, &p);
    EXPECT(p.user[0] != 0);
    carom_spin(0, NULL, 1, &p);
    EXPECT(p.user[0] == 0 && p.user[1] == 0 && p.user[2] == 0);
    impacts_are_the_librarys();
    either_side();
#if RP_2D
    swirl();
#endif
    deposits();
    threads();
    mistakes();
    carom_law_free(glass);
    table("zone 5 floor none:none\n");
    STOPS(carom_reload, "none"); /* gives the last laws back */
    printf("%s: %s\n", RP_2D ? "2-D" : "3-D", failures == 0 ? "all holds" : "FAILED");
    return failures == 0 ? 0 : 1;
}
