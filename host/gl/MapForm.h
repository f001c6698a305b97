// The forms in which renderers keep shadow and glass maps.
#pragma once

#include <tyndall/tyndall.h>

namespace host {

enum class MapLayout {
  Array, ///< GL_TEXTURE_2D_ARRAY, a layer a view
  Atlas, ///< tiles of one GL_TEXTURE_2D
  Cube,  ///< of point lights GL_TEXTURE_CUBE_MAP; others as Array
};

struct MapForm {
  MapLayout layout = MapLayout::Array;
  tyndall::DepthEncoding encoding = tyndall::DepthEncoding::Window; ///< Radial: of lamps; a sun's are Axial
};

} // namespace host
