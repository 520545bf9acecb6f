/* ccsds_xml.c: XML messages through expat. */
#include "base/grow.h"
#include "base/text.h"
#include "orbit/ccsds_parts.h"

#include <expat.h>

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Deepest nesting taken; the messages' own is 7. */
enum { DEEPEST = 32 };

/* Texts grow while items refer to them: their offsets stand in place of addresses until the end. */
typedef struct xml_item {
    ccsds_kind kind;
    size_t keyword, value, unit;
    int line, column;
} xml_item;

/* An element that is open. */
typedef struct open_element {
    size_t keyword, unit;
    int line, column;
    bool has_elements, is_comment;
} open_element;

typedef struct scanner {
    XML_Parser parser;
    ccsds_file *file;
    xml_item *items; /* owned */
    size_t count, capacity;
    text texts, content; /* owned; content: of the innermost element */
    open_element open[DEEPEST];
    int depth;
    bool failed;         /* memory is out */
    const char *refused; /* what the file has and must not have; NULL: nothing */
    int refused_line, refused_column;
} scanner;

/* Keeps a text with its terminator; its offset. */
static size_t keep(scanner *s, const char *bytes, size_t n)
{
    const size_t at = s->texts.length;
    text_append(&s->texts, bytes, n);
    text_append(&s->texts, "", 1);
    return at;
}

/* Without a namespace's prefix, which says nothing here. */
static const char *own_name(const char *name)
{
    const char *colon = strrchr(name, ':');
    return colon ? colon + 1 : name;
}

static size_t keep_name(scanner *s, const char *name)
{
    const size_t at = keep(s, name, strlen(name));
    if (!s->texts.failed) ccsds_capitals(s->texts.data + at);
    return at;
}

static void append(scanner *s, xml_item item)
{
    if (!grow_list(&s->items, &s->capacity, s->count + 1, sizeof *s->items)) {
        s->failed = true;
        XML_StopParser(s->parser, XML_FALSE);
        return;
    }
    s->items[s->count++] = item;
}

static int line_now(const scanner *s)
{
    return (int)XML_GetCurrentLineNumber(s->parser);
}

static int column_now(const scanner *s)
{
    return (int)XML_GetCurrentColumnNumber(s->parser) + 1;
}

static void refuse(scanner *s, const char *what)
{
    s->refused = what;
    s->refused_line = line_now(s);
    s->refused_column = column_now(s);
    XML_StopParser(s->parser, XML_FALSE);
}

static const char *attribute(const XML_Char **attributes, const char *name)
{
    for (; *attributes; attributes += 2)
        if (strcasecmp(attributes[0], name) == 0) return attributes[1];
    return "";
}

/* The element of a message (omm, oem, aem, ...) gives what a message as KVN begins with. */
static void append_version(scanner *s, const char *name, const char *version)
{
    char keyword[32];
    if (strlen(name) != 3 || tolower((unsigned char)name[2]) != 'm') return;
    snprintf(keyword, sizeof keyword, "CCSDS_%s_VERS", name);
    append(s, (xml_item){CCSDS_VALUE, keep_name(s, keyword), keep(s, version, strlen(version)),
                         keep(s, "", 0), line_now(s), column_now(s)});
}

static void XMLCALL on_start(void *user, const XML_Char *written, const XML_Char **attributes)
{
    scanner *s = user;
    const char *name = own_name(written);
    if (s->depth == DEEPEST) {
        refuse(s, "elements nested deeper than 32");
        return;
    }
    if (s->depth > 0 && !s->open[s->depth - 1].has_elements) {
        open_element *parent = &s->open[s->depth - 1];
        parent->has_elements = true;
        append(s, (xml_item){CCSDS_BEGIN, parent->keyword, keep(s, "", 0), keep(s, "", 0),
                             parent->line, parent->column});
    }
    const char *unit = attribute(attributes, "units");
    s->open[s->depth++] = (open_element){.keyword = keep_name(s, name),
                                         .unit = keep(s, unit, strlen(unit)),
                                         .line = line_now(s),
                                         .column = column_now(s),
                                         .is_comment = strcasecmp(name, "COMMENT") == 0};
    append_version(s, name, attribute(attributes, "version"));
    text_clear(&s->content);
}

static void XMLCALL on_end(void *user, const XML_Char *name)
{
    scanner *s = user;
    (void)name;
    const open_element *e = &s->open[--s->depth];
    xml_item item = {CCSDS_END, e->keyword, 0, e->unit, e->line, e->column};
    if (e->has_elements) {
        item.value = keep(s, "", 0);
        item.line = line_now(s);
        item.column = column_now(s);
    } else if (e->is_comment) {
        return;
    } else {
        const char *from = s->content.data ? s->content.data : "";
        const char *to = from + s->content.length;
        while (from < to && isspace((unsigned char)*from))
            from++;
        while (to > from && isspace((unsigned char)to[-1]))
            to--;
        item.kind = CCSDS_VALUE;
        item.value = keep(s, from, (size_t)(to - from));
    }
    append(s, item);
    text_clear(&s->content);
}

static void XMLCALL on_text(void *user, const XML_Char *bytes, int n)
{
    scanner *s = user;
    text_append(&s->content, bytes, (size_t)n);
    s->failed = s->failed || s->content.failed;
}

/* Entities of the file's own could blow it up, and no message needs them. */
static void XMLCALL on_doctype(void *user, const XML_Char *name, const XML_Char *system_id,
                               const XML_Char *public_id, int has_internal)
{
    (void)name, (void)system_id, (void)public_id, (void)has_internal;
    refuse(user, "a document type declaration");
}

/* Turns the offsets into addresses, once texts stay where they are. */
static bool give_items(scanner *s)
{
    s->file->texts = s->texts.data;
    s->texts.data = NULL;
    const char *texts = s->file->texts;
    for (size_t k = 0; k < s->count; k++) {
        const xml_item *x = &s->items[k];
        const ccsds_item item = {x->kind, texts + x->keyword, texts + x->value, texts + x->unit,
                                 x->line, x->column};
        if (!ccsds_append(s->file, &item)) return false;
    }
    return true;
}

static glint_status parse(scanner *s, const char *bytes, size_t size, glint_errors *errors)
{
    const char *path = s->file->path;
    const enum XML_Status parsed = XML_Parse(s->parser, bytes, (int)size, XML_TRUE);
    if (s->refused)
        return errors_add(errors, GLINT_INPUT, (place){path, s->refused_line, s->refused_column},
                          "this XML has %s; expected a message of the CCSDS", s->refused);
    if (s->failed || s->texts.failed)
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    if (parsed != XML_STATUS_OK)
        return errors_add(errors, GLINT_INPUT, (place){path, line_now(s), column_now(s)},
                          "this is no well-formed XML: %s; the file is cut or damaged: get it "
                          "again",
                          XML_ErrorString(XML_GetErrorCode(s->parser)));
    return give_items(s) ? GLINT_OK
                         : errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
}

glint_status ccsds_scan_xml(const char *bytes, size_t size, ccsds_file *file, glint_errors *errors)
{
    scanner s = {.parser = XML_ParserCreate(NULL), .file = file};
    if (!s.parser) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    XML_SetUserData(s.parser, &s);
    XML_SetElementHandler(s.parser, on_start, on_end);
    XML_SetCharacterDataHandler(s.parser, on_text);
    XML_SetStartDoctypeDeclHandler(s.parser, on_doctype);
    const glint_status status = parse(&s, bytes, size, errors);
    XML_ParserFree(s.parser);
    free(s.items);
    text_free(&s.texts);
    text_free(&s.content);
    return status;
}
