#include <fstream>
#include <sstream>
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#define TINYGLTF_IMPLEMENTATION
#include "render/scene/tinygltf.h"
