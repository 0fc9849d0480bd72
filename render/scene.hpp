// A plain draw list. The render helper replaces this line with the real thing.
#pragma once
namespace scanbench::render {
struct Scene {};
}  // namespace scanbench::render
