// Contacts of a sphere with an obstacle, exact or coarse (Smith et al. 2014, section 3.3): the
// collision algorithm that Bullet calls for each such pair.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

namespace macula::scene::physics {

// A coarse contact goes no deeper into a box than this, in simulation units; a sphere that is
// deeper already looks into the box instead.
inline constexpr float kCoarseDepth = 0.05f;

// From now on the dispatcher meets spheres and obstacles by this algorithm. A sphere's user index
// says how many levels it leaves out: 0 is Bullet's own algorithm, untouched.
// The dispatcher's configuration must allow algorithms of sphere_contact_bytes().
void use_sphere_contacts(btCollisionDispatcher& dispatcher);
int sphere_contact_bytes();

} // namespace macula::scene::physics
