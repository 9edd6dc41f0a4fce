# Writes OUTPUT, a C++ table of the FILES (separated by |) by their path below ROOT: see snippets.h.
string(REPLACE "|" ";" files "${FILES}")
set(rows "")
foreach(file ${files})
  file(RELATIVE_PATH path ${ROOT} ${file})
  file(READ ${file} text)
  string(APPEND rows "    {\"${path}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"render/user_shapes/snippets.h\"

namespace foveray::user_shapes {

std::span<const std::pair<std::string_view, std::string_view>> snippets() {
    static const std::pair<std::string_view, std::string_view> table[] = {
${rows}    };
    return table;
}

}  // namespace foveray::user_shapes
")
