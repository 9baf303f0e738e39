#pragma once

namespace granulaw::plugin {

/// See GRANULAW_EXPOSE.
template <class Tag, auto member>
struct Expose
{
  friend auto exposed(Tag) { return member; }
};

}  // namespace granulaw::plugin

/// Makes a private member of a class of LIGGGHTS reachable that has no call for it. An explicit instantiation
/// may name private members ([temp.spec]). Stands in namespace granulaw::plugin:
///
///   GRANULAW_EXPOSE(Tag, Class, member);
///   object->*exposed(Tag{})
#define GRANULAW_EXPOSE(Tag, Class, member) \
  struct Tag                                \
  {                                         \
    friend auto exposed(Tag);               \
  };                                        \
  template struct Expose<Tag, &Class::member>
