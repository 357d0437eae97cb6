/// The whole library in one include: open a device, load a scene, render, read images and timings,
/// and judge pictures.
#pragma once

#include "host/cl/device.hpp"
#include "host/metric/classic.hpp"
#include "host/metric/flip.hpp"
#include "host/metric/foveated.hpp"
#include "host/metric/heat_map.hpp"
#include "host/metric/temporal.hpp"
#include "host/output/image.hpp"
#include "host/output/read_image.hpp"
#include "host/render/renderer.hpp"
#include "scenes/load.hpp"
