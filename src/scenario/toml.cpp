// toml.cpp: turns toml++'s tree into the plain one of toml.h. Everything that can throw stands
// inside parse(), whose callers get a status.
#include "scenario/toml.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace
{

const char *const OVERRIDE_PATH = "--set";

struct out_of_memory {
};

char *copy_text(std::string_view text)
{
    char *copy = string_copy(text.data(), text.size());
    if (!copy) throw out_of_memory();
    return copy;
}

place place_of(const toml::source_region &region, const char *path)
{
    return place{path, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

void release(toml_node *node)
{
    for (int i = 0; i < node->n_children; i++)
        release(&node->children[i]);
    std::free(node->children);
    std::free(node->string);
    std::free(node->key);
    *node = toml_node{};
}

toml_node *make_children(toml_node *parent, size_t n)
{
    if (n == 0) return nullptr;
    parent->children = static_cast<toml_node *>(std::calloc(n, sizeof(toml_node)));
    if (!parent->children) throw out_of_memory();
    return parent->children;
}

toml_moment moment_of(const toml::node &node)
{
    toml_moment m{};
    const auto set_date = [&m](const toml::date &d) {
        m.year = d.year, m.month = d.month, m.day = d.day, m.has_date = true;
    };
    const auto set_time = [&m](const toml::time &t) {
        m.hour = t.hour, m.minute = t.minute, m.second = t.second;
        m.nanosecond = static_cast<int>(t.nanosecond), m.has_time = true;
    };
    if (const auto *d = node.as_date()) set_date(d->get());
    if (const auto *t = node.as_time()) set_time(t->get());
    if (const auto *dt = node.as_date_time()) {
        set_date(dt->get().date);
        set_time(dt->get().time);
        if (dt->get().offset) {
            m.has_offset = true;
            m.offset_min = dt->get().offset->minutes;
        }
    }
    return m;
}

// Fills *to (zeroed) from a toml++ node. What is built so far can always be released.
void convert(const toml::node &from, const char *path, glint_errors *errors, toml_node *to)
{
    to->where = to->key_where = place_of(from.source(), path);
    if (const auto *table = from.as_table()) {
        to->type = TOML_TABLE;
        to->is_inline = table->is_inline();
        toml_node *child = make_children(to, table->size());
        for (const auto &[key, value] : *table) {
            to->n_children++;
            convert(value, path, errors, child);
            child->key = copy_text(key.str());
            child->key_where = place_of(key.source(), path);
            child++;
        }
    } else if (const auto *array = from.as_array()) {
        to->type = TOML_ARRAY;
        toml_node *child = make_children(to, array->size());
        for (const auto &value : *array) {
            to->n_children++;
            convert(value, path, errors, child++);
        }
    } else if (const auto *string = from.as_string()) {
        to->type = TOML_STRING;
        to->string = copy_text(string->get());
        if (string->get().find('\0') != std::string::npos)
            errors_add(errors, GLINT_INPUT, to->where,
                       "this string has a zero byte in it; expected text");
    } else if (const auto *integer = from.as_integer()) {
        to->type = TOML_INTEGER;
        to->integer = integer->get();
        to->number = static_cast<double>(integer->get());
    } else if (const auto *real = from.as_floating_point()) {
        to->type = TOML_FLOAT;
        to->number = real->get();
        if (!std::isfinite(to->number))
            errors_add(errors, GLINT_INPUT, to->where, "found %s; expected a finite number",
                       std::isnan(to->number) ? "nan" : "inf");
    } else if (const auto *boolean = from.as_boolean()) {
        to->type = TOML_BOOLEAN;
        to->boolean = boolean->get();
    } else {
        to->type = TOML_TIME;
        to->moment = moment_of(from);
    }
}

// Sorts the children of every table by their place, since toml++ keeps tables in order of key.
int by_place(const void *a, const void *b)
{
    const place &x = static_cast<const toml_node *>(a)->key_where;
    const place &y = static_cast<const toml_node *>(b)->key_where;
    return x.line != y.line ? (x.line < y.line ? -1 : 1)
                            : (x.column > y.column) - (x.column < y.column);
}

void restore_order(toml_node *node)
{
    for (int i = 0; i < node->n_children; i++)
        restore_order(&node->children[i]);
    if (node->type == TOML_TABLE && node->n_children > 1)
        std::qsort(node->children, static_cast<size_t>(node->n_children), sizeof(toml_node),
                   by_place);
}

// Most parts of one dotted key. toml++ limits how deep values nest, but not how many parts a key
// has, and trees as deep as that would be walked by recursion.
constexpr int MOST_KEY_PARTS = 16;

// The index behind the string that begins with the quote at `at`, or of the end of its line where
// it is not closed.
size_t skip_string(std::string_view text, size_t at)
{
    const char quote = text[at];
    const bool many_lines = text.size() - at >= 3 && text[at + 1] == quote && text[at + 2] == quote;
    const size_t width = many_lines ? 3 : 1;
    for (at += width; at < text.size(); at++) {
        if (quote == '"' && text[at] == '\\')
            at++;
        else if (text[at] == '\n' && !many_lines)
            return at;
        else if (text[at] == quote && (!many_lines || text.substr(at, 3) == std::string(3, quote)))
            return at + width;
    }
    return text.size();
}

// The dot with which some key gets too many parts; npos where there is none.
size_t find_deep_key(std::string_view text)
{
    int parts = 1;
    for (size_t at = 0; at < text.size(); at++) {
        switch (text[at]) {
        case '"':
        case '\'':
            at = skip_string(text, at) - 1;
            break;
        case '#':
            at = std::min(text.find('\n', at), text.size()) - 1;
            break;
        case '.':
            if (++parts > MOST_KEY_PARTS) return at;
            break;
        case ',':
        case '=':
        case '[':
        case ']':
        case '{':
        case '}':
        case '\n':
            parts = 1;
            break;
        default:
            break;
        }
    }
    return std::string_view::npos;
}

glint_status refuse_deep_key(std::string_view text, size_t at, const char *path,
                             glint_errors *errors)
{
    const std::string_view before = text.substr(0, at);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const size_t start = before.rfind('\n') + 1; // 0 without one
    return errors_add(errors, GLINT_INPUT,
                      place{path, static_cast<int>(line), static_cast<int>(at - start) + 1},
                      "this key has more than %d parts; expected fewer dots", MOST_KEY_PARTS);
}

// *is_syntax: set where the text is no TOML; NULL allowed.
glint_status parse(std::string_view text, const char *path, toml_node *root, bool *is_syntax,
                   glint_errors *errors)
{
    const size_t before = glint_errors_error_count(errors);
    const size_t deep = find_deep_key(text);
    if (deep != std::string_view::npos) return refuse_deep_key(text, deep, path, errors);
    try {
        const toml::table table = toml::parse(text, std::string_view(path));
        convert(table, path, errors, root);
        restore_order(root);
    } catch (const toml::parse_error &error) {
        const std::string_view why = error.description();
        if (is_syntax) *is_syntax = true;
        return errors_add(errors, GLINT_INPUT, place_of(error.source(), path),
                          "TOML syntax error: %.*s", static_cast<int>(why.size()), why.data());
    } catch (const out_of_memory &) {
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    } catch (const std::bad_alloc &) {
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    } catch (const std::exception &error) {
        return errors_add(errors, GLINT_INTERNAL, place{path, 0, 0}, "%s", error.what());
    }
    return glint_errors_error_count(errors) > before ? GLINT_INPUT : GLINT_OK;
}

bool array_index(const char *key, int n, int *index)
{
    char *end = nullptr;
    if (!key || key[0] < '0' || key[0] > '9') return false;
    const long value = std::strtol(key, &end, 10);
    if (*end || value < 0 || value >= n) return false;
    *index = static_cast<int>(value);
    return true;
}

glint_status merge(toml_node *into, toml_node *from, const char *assignment, glint_errors *errors);

// Puts `from` (emptied) in place of `into`, which keeps its key.
void replace(toml_node *into, toml_node *from)
{
    char *key = into->key;
    into->key = nullptr;
    release(into);
    *into = *from;
    std::free(into->key);
    into->key = key;
    *from = toml_node{};
}

// Puts a new value where an old one stands, or goes down into both while the new one is only a
// path.
glint_status put(toml_node *into, toml_node *from, const char *assignment, glint_errors *errors)
{
    if (from->type == TOML_TABLE && !from->is_inline &&
        (into->type == TOML_TABLE || into->type == TOML_ARRAY))
        return merge(into, from, assignment, errors);
    replace(into, from);
    return GLINT_OK;
}

glint_status append(toml_node *table, toml_node *from, glint_errors *errors)
{
    const size_t n = static_cast<size_t>(table->n_children) + 1;
    auto *children = static_cast<toml_node *>(std::realloc(table->children, n * sizeof(toml_node)));
    if (!children) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    table->children = children;
    children[table->n_children++] = *from;
    *from = toml_node{};
    return GLINT_OK;
}

glint_status merge(toml_node *into, toml_node *from, const char *assignment, glint_errors *errors)
{
    for (int i = 0; i < from->n_children; i++) {
        toml_node *child = &from->children[i], *old = nullptr;
        if (into->type == TOML_ARRAY) {
            int index;
            if (!array_index(child->key, into->n_children, &index))
                return errors_add(errors, GLINT_INPUT, PLACE_NONE,
                                  "--set %s: '%s' is not an element of this array; expected a "
                                  "number from 0 to %d",
                                  assignment, child->key, into->n_children - 1);
            old = &into->children[index];
        } else {
            old = const_cast<toml_node *>(toml_child(into, child->key));
        }
        const glint_status status =
            old ? put(old, child, assignment, errors) : append(into, child, errors);
        if (status) return status;
    }
    return GLINT_OK;
}

} // namespace

extern "C" glint_status toml_read(const char *path, place asked_from, toml_document **out,
                                  glint_errors *errors)
{
    *out = nullptr;
    auto *document = static_cast<toml_document *>(std::calloc(1, sizeof(toml_document)));
    if (document) document->path = string_copy(path, std::strlen(path));
    if (!document || !document->path) {
        toml_free(document);
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    glint_error error;
    size_t size;
    glint_status status = file_read(path, &document->text, &size, asked_from, &error);
    if (status)
        errors_take(errors, &error, asked_from);
    else
        status = parse(std::string_view(document->text, size), document->path, &document->root,
                       nullptr, errors);
    if (status) {
        toml_free(document);
        return status;
    }
    *out = document;
    return GLINT_OK;
}

extern "C" void toml_free(toml_document *document)
{
    if (!document) return;
    release(&document->root);
    std::free(document->text);
    std::free(document->path);
    std::free(document);
}

extern "C" glint_status toml_override(toml_document *document, const char *assignment,
                                      glint_errors *errors)
{
    const char *equals = std::strchr(assignment, '=');
    if (!equals || equals == assignment)
        return errors_add(errors, GLINT_ARGUMENT, PLACE_NONE,
                          "--set '%s': expected key=value, as in time.step_s=0.5", assignment);
    toml_node from{};
    bool is_syntax = false;
    glint_status status = parse(assignment, OVERRIDE_PATH, &from, &is_syntax, errors);
    if (is_syntax)
        errors_add(errors, status, PLACE_NONE,
                   "--set '%s': the value must be TOML: texts stand in quotes, as in "
                   "--set 'orbit.tle_name=\"HST\"'",
                   assignment);
    if (!status && from.n_children == 0) // a comment: '#=1'
        status = errors_add(errors, GLINT_ARGUMENT, PLACE_NONE,
                            "--set '%s': there is no key; expected key=value, as in "
                            "time.step_s=0.5",
                            assignment);
    if (!status) status = merge(&document->root, &from, assignment, errors);
    release(&from);
    return status;
}

extern "C" const toml_node *toml_child(const toml_node *table, const char *key)
{
    if (table->type != TOML_TABLE) return nullptr;
    for (int i = 0; i < table->n_children; i++)
        if (string_equal(table->children[i].key, key)) return &table->children[i];
    return nullptr;
}

extern "C" const char *toml_type_name(toml_type type)
{
    switch (type) {
    case TOML_TABLE:
        return "a table";
    case TOML_ARRAY:
        return "an array";
    case TOML_STRING:
        return "a string";
    case TOML_INTEGER:
        return "a whole number";
    case TOML_FLOAT:
        return "a number";
    case TOML_BOOLEAN:
        return "true or false";
    case TOML_TIME:
        return "a date or time";
    }
    return "a value";
}
