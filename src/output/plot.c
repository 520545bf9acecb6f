#include "output/plot.h"

#include "output/file.h"
#include "output/utf8.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX has it, but in no header */

struct plot {
    const char *terminal; /* of the kinds below */
    char *gnuplot;        /* owned; its path */
    out_file *file;       /* owned */
};

/* The kinds of pictures. Letters of about 3 mm on a picture of about 30 cm. */
static const struct {
    const char *suffix, *terminal;
} KINDS[] = {
    {".svg", "svg size 1200,800 dynamic font 'sans-serif,16' background 'white'"},
    {".png", "pngcairo size 1200,800 font 'sans,14' background 'white'"},
    {".pdf", "pdfcairo size 25cm,16.7cm font 'sans,14' background 'white'"},
};

enum { N_KINDS = sizeof KINDS / sizeof *KINDS };

/* ------------------------------------------------------------ what is at hand */

/* The terminal for a path's suffix, or NULL. */
static const char *terminal_for(const char *path)
{
    const size_t n = strlen(path);
    for (size_t k = 0; k < N_KINDS; k++) {
        const size_t suffix = strlen(KINDS[k].suffix);
        if (n > suffix && strcasecmp(path + n - suffix, KINDS[k].suffix) == 0)
            return KINDS[k].terminal;
    }
    return NULL;
}

static bool is_program(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISREG(info.st_mode) && access(path, X_OK) == 0;
}

/* The path of gnuplot, from malloc. NULL when it is not there (*failed false), or memory is out.
 * Relative folders of PATH are passed over: what lies in the current folder is no installed
 * program. */
static char *find_gnuplot(bool *failed)
{
    const char *folders = getenv("PATH");
    *failed = false;
    while (folders && *folders) {
        const size_t n = strcspn(folders, ":");
        if (folders[0] == '/') {
            text path = {0};
            text_append(&path, folders, n);
            text_add(&path, "/gnuplot");
            *failed = path.failed;
            if (path.failed || is_program(path.data)) return path.data;
            text_free(&path);
        }
        folders += n + (folders[n] == ':');
    }
    return NULL;
}

glint_status plot_open(const char *path, plot **out, glint_error *error)
{
    *out = NULL;
    const char *terminal = terminal_for(path);
    if (!terminal)
        return error_set(
            error, GLINT_ARGUMENT, (place){path, 0, 0},
            "pictures are written as .svg, .png or .pdf; expected a name that ends so");
    bool failed;
    plot *p = calloc(1, sizeof *p);
    if (!p) return error_no_memory(error);
    p->terminal = terminal;
    p->gnuplot = find_gnuplot(&failed);
    glint_status status = GLINT_OK;
    if (failed)
        status = error_no_memory(error);
    else if (!p->gnuplot)
        status =
            error_set(error, GLINT_OUTPUT, (place){path, 0, 0},
                      "gnuplot, which draws the pictures, is not on PATH; on Debian and Ubuntu "
                      "it comes with: apt-get install gnuplot-nox");
    if (!status) status = out_file_open(path, &p->file, error);
    if (status)
        plot_abandon(p);
    else
        *out = p;
    return status;
}

glint_status glint_plot_check(const char *path, const char *table, glint_error *error)
{
    plot *p;
    glint_status status = out_file_check_two(table, path, error);
    if (!status) status = plot_open(path, &p, error);
    if (!status) plot_abandon(p);
    return status;
}

void plot_abandon(plot *p)
{
    if (!p) return;
    out_file_abandon(p->file);
    free(p->gnuplot);
    free(p);
}

/* A single quote cannot stand in single quotes: doubling it, as the manual says, fails at the start
 * of a string (gnuplot 5.4). So the text is put together from pieces: 'it' . "'" . 's'. */
void plot_quote(text *script, const char *string)
{
    const size_t n = strlen(string);
    text_char(script, '\'');
    for (size_t i = 0, length; i < n; i += length ? length : 1) {
        unsigned c;
        length = utf8_read(string + i, n - i, &c);
        if (length == 0)
            text_char(script, '?');
        else if (c == '\'')
            text_add(script, "' . \"'\" . '");
        else if (c < ' ' || c == 127)
            text_char(script, ' ');
        else
            text_append(script, string + i, length);
    }
    text_char(script, '\'');
}

/* ---------------------------------------------------------------------- time */

/* Days from 1 January 1970 to a date of the Gregorian calendar. Years are counted from March, so
 * that the day that some of them have more is the last; 146097 days make 400 years. */
static int64_t days_of(int year, int month, int day)
{
    const int64_t y = month > 2 ? year : year - 1, m = (month + 9) % 12; /* March is 0 */
    const int64_t from_march = 365 * y + y / 4 - y / 100 + y / 400 + (153 * m + 2) / 5 + day - 1;
    return from_march - 719468; /* those before 1970 */
}

double plot_utc_s(const glint_utc *u)
{
    const double day_s = 86400.0 * (double)days_of(u->year, u->month, u->day);
    return day_s + 3600.0 * u->hour + 60.0 * u->minute + u->second + 1e-6 * u->microsecond;
}

double plot_round_step(double least)
{
    const double ten = pow(10, floor(log10(least))), part = least / ten; /* 1 to 10 */
    return ten * (part <= 1 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10);
}

void plot_time_axis(double from_s, double to_s, text *script)
{
    const double MINUTE = 60, DAY = 86400, span = to_s - from_s; /* s */
    const char *marks = span < 0.2 * MINUTE ? "%H:%M:%.1S"
                        : span < 5 * MINUTE ? "%H:%M:%S"
                        : span < DAY        ? "%H:%M"
                        : span < 8 * DAY    ? "%H:%M\\n%d %b"
                        : span < 600 * DAY  ? "%d %b"
                                            : "%b %Y";
    text_printf(script,
                "first = %.6f\nlast = %.6f\nset xrange [first:last]\n"
                "set xdata time\nset timefmt '%%s'\nmarks = \"%s\"\n"
                "day = '%%d %%b %%Y'\nbottom = 'UTC, ' . strftime(day, first)\n"
                "if (strftime(day, last) ne strftime(day, first)) {\n"
                "    bottom = bottom . ' to ' . strftime(day, last)\n}\n",
                from_s, to_s, marks);
}

/* --------------------------------------------------------- talking to gnuplot */

/* Our ends of the three connections, -1 when closed, and what came through them. */
typedef struct talk {
    int to, from, complaints;
    const char *script; /* what is still to be sent */
    size_t left;
    text picture, said; /* owned */
} talk;

static void close_end(int *fd)
{
    if (*fd >= 0) close(*fd);
    *fd = -1;
}

/* Two connected ends, closed in programs that are started, and none of them 0, 1 or 2, which are
 * the child's ends. A pair of sockets, since writing to a pipe that nobody reads raises a signal.
 */
static bool connect_ends(int ends[2])
{
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) {
        ends[0] = ends[1] = -1;
        return false;
    }
    for (int k = 0; k < 2; k++) {
        const int moved = fcntl(ends[k], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        close(ends[k]);
        ends[k] = moved;
    }
    if (ends[0] >= 0 && ends[1] >= 0) return true;
    close_end(&ends[0]);
    close_end(&ends[1]);
    return false;
}

/* Starts gnuplot with default settings, without a user's start-up files. theirs: its standard
 * input, output and error. Returns an error number. */
static int spawn(const char *gnuplot, const int theirs[3], pid_t *child)
{
    char name[] = "gnuplot", defaults[] = "--default-settings", from_input[] = "-";
    char *const words[] = {name, defaults, from_input, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t pipe_signal;
    int failed = posix_spawn_file_actions_init(&actions);
    if (failed) return failed;
    failed = posix_spawnattr_init(&attributes);
    if (failed) {
        posix_spawn_file_actions_destroy(&actions);
        return failed;
    }
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE); /* which the caller may have set to be ignored */
    posix_spawnattr_setsigdefault(&attributes, &pipe_signal);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    for (int fd = 0; fd < 3 && !failed; fd++)
        failed = posix_spawn_file_actions_adddup2(&actions, theirs[fd], fd);
    if (!failed) failed = posix_spawn(child, gnuplot, &actions, &attributes, words, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

/* Starts gnuplot and connects it. errno says what failed. */
static bool start(const char *gnuplot, talk *t, pid_t *child)
{
    int ends[3][2], theirs[3], n = 0;
    while (n < 3 && connect_ends(ends[n]))
        n++;
    int failed = n < 3 ? errno : 0;
    if (!failed) {
        for (int fd = 0; fd < 3; fd++)
            theirs[fd] = ends[fd][1];
        failed = spawn(gnuplot, theirs, child);
    }
    for (int fd = 0; fd < n; fd++) {
        close(ends[fd][1]);
        if (failed) close(ends[fd][0]);
    }
    errno = failed;
    if (failed) return false;
    t->to = ends[0][0];
    t->from = ends[1][0];
    t->complaints = ends[2][0];
    return true;
}

/* Sends what gnuplot takes now; closes its input at the end, or when it no longer listens. */
static void send_script(talk *t)
{
    const ssize_t n = send(t->to, t->script, t->left, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) {
        t->script += n;
        t->left -= (size_t)n;
    }
    const bool again = n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
    if (t->left == 0 || (n < 0 && !again)) close_end(&t->to);
}

/* Takes what has come; closes the end where there is no more. */
static void receive(int *fd, text *into)
{
    enum { AT_ONCE = 1 << 16 }; /* bytes */
    if (!text_reserve(into, AT_ONCE)) {
        close_end(fd);
        return;
    }
    const ssize_t n = read(*fd, into->data + into->length, AT_ONCE);
    if (n > 0) {
        into->length += (size_t)n;
        into->data[into->length] = '\0';
    } else if (n == 0 || errno != EINTR) {
        close_end(fd);
    }
}

/* Sends the script and takes the answers until gnuplot has closed its side. */
static void converse(talk *t)
{
    while (t->from >= 0 || t->complaints >= 0) {
        struct pollfd ends[3] = {
            {.fd = t->to, .events = POLLOUT}, /* negative ones are passed over */
            {.fd = t->from, .events = POLLIN},
            {.fd = t->complaints, .events = POLLIN}};
        if (poll(ends, 3, -1) < 0) {
            if (errno == EINTR) continue;
            break;
        }
        if (ends[0].revents) send_script(t);
        if (ends[1].revents) receive(&t->from, &t->picture);
        if (ends[2].revents) receive(&t->complaints, &t->said);
    }
    close_end(&t->to);
    close_end(&t->from);
    close_end(&t->complaints);
}

/* ------------------------------------------------------------------- drawing */

/* What gnuplot said, on one line: without its pointer under the word in question, and the echo. */
static void make_line(text *said)
{
    size_t n = 0;
    for (size_t k = 0; k < said->length; k++) {
        const char c = said->data[k];
        const bool blank = (unsigned char)c <= ' ' || c == 127;
        if (!blank)
            said->data[n++] = c;
        else if (n > 0 && said->data[n - 1] != ' ')
            said->data[n++] = ' ';
    }
    while (n > 0 && said->data[n - 1] == ' ')
        n--;
    if (said->data) said->data[n] = '\0';
    said->length = n;
}

/* What came of the conversation. ended: as waitpid says; known: it could say so. */
static glint_status judge(talk *t, bool known, int ended, glint_error *error)
{
    if (t->picture.failed || t->said.failed) return error_no_memory(error);
    const bool good = !known || (WIFEXITED(ended) && WEXITSTATUS(ended) == 0);
    if (good && t->picture.length > 0) return GLINT_OK;
    make_line(&t->said);
    const char *said = t->said.length ? t->said.data : "nothing";
    if (known && WIFSIGNALED(ended))
        return error_set(error, GLINT_OUTPUT, PLACE_NONE,
                         "gnuplot was ended by signal %d; it said: %s", WTERMSIG(ended), said);
    return error_set(error, GLINT_OUTPUT, PLACE_NONE, "gnuplot drew no picture; it said: %s", said);
}

/* Has gnuplot draw; the picture is in t->picture. */
static glint_status draw(const plot *p, const char *script, size_t n, talk *t, glint_error *error)
{
    text whole = {0};
    text_printf(&whole, "set encoding utf8\nset terminal %s\n", p->terminal);
    text_append(&whole, script, n);
    text_add(&whole, "\nunset output\n");
    if (whole.failed) {
        text_free(&whole);
        return error_no_memory(error);
    }
    *t = (talk){.to = -1, .from = -1, .complaints = -1, .script = whole.data, .left = whole.length};
    pid_t child;
    glint_status status = GLINT_OK;
    if (start(p->gnuplot, t, &child)) {
        int ended = 0;
        pid_t waited;
        converse(t);
        while ((waited = waitpid(child, &ended, 0)) < 0 && errno == EINTR)
            ;
        status = judge(t, waited == child, ended, error);
    } else {
        status = error_set(error, GLINT_OUTPUT, (place){p->gnuplot, 0, 0}, "cannot start it: %s",
                           strerror(errno));
    }
    text_free(&whole);
    return status;
}

glint_status plot_finish(plot *p, const char *script, size_t n, glint_error *error)
{
    talk t = {0};
    glint_status status = draw(p, script, n, &t, error);
    if (!status) status = out_file_write(p->file, t.picture.data, t.picture.length, error);
    if (!status) {
        out_file *file = p->file;
        p->file = NULL;
        status = out_file_commit(file, error);
    }
    text_free(&t.picture);
    text_free(&t.said);
    plot_abandon(p);
    return status;
}
