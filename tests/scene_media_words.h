// Pieces of scene files with media, for tests that read such files.
#ifndef PM_TEST_SCENE_MEDIA_WORDS_H
#define PM_TEST_SCENE_MEDIA_WORDS_H

#define FOG "<medium type='homogeneous' id='fog'><float name='sigma_t' value='0.5'/></medium>"
#define SMOKE "<medium type='homogeneous' id='smoke'><float name='sigma_t' value='3'/></medium>"
#define IN(id) "<ref name='interior' id='" id "'/>"
#define OUT(id) "<ref name='exterior' id='" id "'/>"
#define FLIP "<boolean name='flip_normals' value='true'/>"

/// A sphere with these sides, given as printf's text, at x, 0, 0.
#define BALL(x, radius, sides)                                                                 \
    "<shape type='sphere'><point name='center' value='" x                                      \
    " 0 0'/><float name='radius' value='" radius "'/>" sides "</shape>"

#endif
