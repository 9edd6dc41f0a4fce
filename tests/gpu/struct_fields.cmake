# foveray_struct_fields(OUTPUT HEADERS…): lists every field of every struct in the headers, for the round-trip test, as a
# header for C++ and GLSL. Whoever includes it provides `visit` for each leaf type. A field is `type name;` or
# `type name[size];`.
function(foveray_struct_fields output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
  set(includes "")
  set(names "")
  set(bodies "")
  foreach(header ${ARGN})
    file(RELATIVE_PATH path ${CMAKE_SOURCE_DIR} ${header})
    string(APPEND includes "#include \"${path}\"\n")
    file(READ ${header} text)
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REPLACE ";" "|" text "${text}")  # CMake's own separator
    while(text MATCHES "struct ([A-Za-z0-9_]+) {([^}]*)}")
      list(APPEND names ${CMAKE_MATCH_1})
      list(APPEND bodies "${CMAKE_MATCH_2}")
      string(FIND "${text}" "${CMAKE_MATCH_0}" begin)
      string(LENGTH "${CMAKE_MATCH_0}" length)
      math(EXPR begin "${begin} + ${length}")
      string(SUBSTRING "${text}" ${begin} -1 text)
    endwhile()
  endforeach()

  set(functions "")
  set(prototypes "")
  set(copies "")
  set(arrays "")
  set(each "")
  set(number 0)
  foreach(name body IN ZIP_LISTS names bodies)
    set(lines "")
    string(REGEX REPLACE "[ \n]+" " " body "${body}")
    while(body MATCHES "^ ?([A-Za-z0-9_]+) ([A-Za-z0-9_]+)(\\[([A-Za-z0-9_]+)\\])?\\|(.*)$")
      set(type ${CMAKE_MATCH_1})
      set(field ${CMAKE_MATCH_2})
      set(count "${CMAKE_MATCH_4}")
      set(body "${CMAKE_MATCH_5}")
      set(visitor FIELD)
      if(type IN_LIST names)
        set(visitor FIELDS)
      endif()
      if(count STREQUAL "")
        string(APPEND lines "    ${visitor}(${field});\n")
      else()
        string(APPEND lines "    for (int i = 0; i < int(${count}); ++i) ${visitor}(${field}[i]);\n")
      endif()
    endwhile()
    if(NOT body MATCHES "^ ?$")
      message(FATAL_ERROR "struct ${name}: cannot read the fields from '${body}' on")
    endif()
    string(APPEND functions "FIELDS_OF(${name}) {\n${lines}}\n")
    string(APPEND prototypes "void fields(inout ${name} s);\n")
    string(APPEND arrays "FOVERAY_ARRAY(${name}Test, ${name});\n")
    string(APPEND copies "    if (which == ${number}u) {
        ${name} s = ${name}Test(structs).at[element];
        fields(s);
        if (write) ${name}Test(structs).at[element] = s;
    }\n")
    string(APPEND each " \\\n    DO(${name}, ${number})")
    math(EXPR number "${number} + 1")
  endforeach()

  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT
"// Made by tests/gpu/struct_fields.cmake.
@includes@
#ifdef __cplusplus
#define FIELDS_OF(Struct) template <typename Visitor> void fields(Visitor& visit, Struct& s)
#define FIELD(member) visit(s.member)
#define FIELDS(member) fields(visit, s.member)
#else
#define FIELDS_OF(Struct) void fields(inout Struct s)
#define FIELD(member) visit(s.member)
#define FIELDS(member) fields(s.member)
@prototypes@
#endif
FOVERAY_SHARED_BEGIN
@functions@
FOVERAY_SHARED_END
#ifdef __cplusplus
#define FOR_EACH_SHARED_STRUCT(DO)@each@
#else
@arrays@
// Visits the fields of element `element` of an array of the struct with number `which`.
void visit_struct(uint which, uint64_t structs, uint element, bool write) {
@copies@}
#endif
")
endfunction()
